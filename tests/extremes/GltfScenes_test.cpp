// SPDX-License-Identifier: MIT
// The glTF reader: scenes, nodes, lights, skins and animations.
#include "GltfFiles.h"

#include <osgEnvLight/ModelCameras>

#include <osg/FrontFace>
#include <osg/LightSource>
#include <osgAnimation/BasicAnimationManager>
#include <osgAnimation/MorphGeometry>
#include <osgAnimation/RigGeometry>
#include <osgUtil/Optimizer>
#include <osgUtil/UpdateVisitor>

using namespace gltffiles;

namespace
{

/** Brings a scene to a time [s], as a viewer does. */
void update(osg::Node* root, double time)
{
    osgUtil::UpdateVisitor visitor;
    osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    stamp->setSimulationTime(time);
    visitor.setFrameStamp(stamp);
    visitor.setTraversalNumber(unsigned(time * 1000.0) + 1);
    root->accept(visitor);
}

osg::Vec3d placeOf(osg::Node* root, const osg::Vec3d& point = osg::Vec3d())
{
    const std::vector<osg::Geode*> geodes = find<osg::Geode>(root);
    return geodes.empty() ? osg::Vec3d() : point * geodes[0]->getWorldMatrices()[0];
}

void expectNear(const osg::Vec3d& a, const osg::Vec3d& b, double tolerance = 1e-5)
{
    EXPECT_NEAR((a - b).length(), 0.0, tolerance) << a.x() << " " << a.y() << " " << a.z();
}

/** One triangle whose node an animation moves. */
File animated(const char* path, const std::vector<float>& times, const std::vector<float>& values, const char* type, int width,
              const char* interpolation)
{
    File file;
    file.show(file.triangle());
    const int input = file.scalars(times);
    const int output = file.accessor(values, kFloat, type, width);
    file.add("animations", {{"name", "turn"},
                            {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return file;
}

}  // namespace

TEST(GltfScenes, YUpBecomesZUpUnlessItIsKept)
{
    File file;
    file.show(file.triangle());
    expectNear(placeOf(readNode(file, ""), osg::Vec3d(1, 2, 3)), osg::Vec3d(1, -3, 2));
    expectNear(placeOf(readNode(file, "keepYUp"), osg::Vec3d(1, 2, 3)), osg::Vec3d(1, 2, 3));
}

TEST(GltfScenes, TransformsByPartsAndByMatrix)
{
    File file;
    file.show(file.triangle());
    file.document["nodes"][0].update(
        {{"translation", {1, 2, 3}}, {"rotation", {0, 0, std::sqrt(.5), std::sqrt(.5)}}, {"scale", {2, 1, 1}}});
    file.add("nodes", {{"name", "above"}, {"children", {0}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}});
    const osg::ref_ptr<osg::Node> root = readNode(file);
    expectNear(placeOf(root, osg::Vec3d(1, 0, 0)), osg::Vec3d(11, 4, 3));
    ASSERT_EQ(find<osg::MatrixTransform>(root).size(), 3u);
    EXPECT_EQ(find<osg::MatrixTransform>(root)[1]->getName(), "above");
}

TEST(GltfScenes, TheDefaultSceneElseTheFirstElseAllRoots)
{
    File file;
    for (int i = 0; i < 3; ++i) file.show(file.triangle());
    file.document["nodes"].push_back({{"name", "group"}, {"children", {2}}});
    EXPECT_EQ(find<osg::Geode>(readNode(file)).size(), 3u);
    file.document["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0, 3}}}};
    EXPECT_EQ(find<osg::Geode>(readNode(file)).size(), 1u);
    file.document["scene"] = 1;
    EXPECT_EQ(find<osg::Geode>(readNode(file)).size(), 2u);
}

TEST(GltfScenes, MirroredNodesTurnTheirFaces)
{
    File file;
    file.show(file.triangle());
    file.document["nodes"][0]["scale"] = {-1, 1, 1};
    file.add("nodes", {{"children", {0}}, {"scale", {1, -1, 1}}});
    const osg::ref_ptr<osg::Node> root = readNode(file);
    const auto frontOf = [](osg::Node* node) {
        return static_cast<osg::FrontFace*>(node->getStateSet()->getAttribute(osg::StateAttribute::FRONTFACE))->getMode();
    };
    const std::vector<osg::MatrixTransform*> nodes = find<osg::MatrixTransform>(root);
    ASSERT_EQ(nodes.size(), 3u);
    EXPECT_EQ(frontOf(nodes[1]), osg::FrontFace::CLOCKWISE);
    EXPECT_EQ(frontOf(nodes[2]), osg::FrontFace::COUNTER_CLOCKWISE);
}

TEST(GltfScenes, TheOptimizerKeepsTangentsWithTheirFaces)
{
    File file;
    json primitive = file.triangle();
    primitive["attributes"]["TANGENT"] = file.vec4({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    file.show(primitive);
    file.document["nodes"][0]["rotation"] = {0, 0, std::sqrt(.5), std::sqrt(.5)};
    const osg::ref_ptr<osg::Node> root = readNode(file, "");
    osgUtil::Optimizer optimizer;
    optimizer.optimize(root);
    expectNear(placeOf(root, osg::Vec3d(1, 0, 0)), osg::Vec3d(0, 0, 1));
}

TEST(GltfScenes, Lights)
{
    File file;
    file.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", osg::PI}, {"color", {1, .5, 0}}},
        {{"type", "point"}, {"name", "bulb"}, {"intensity", 4 * osg::PI}},
        {{"type", "spot"}, {"spot", {{"outerConeAngle", osg::PI / 3}, {"innerConeAngle", osg::PI / 3}}}}};
    for (int i = 0; i < 3; ++i) file.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const osg::ref_ptr<osg::Node> root = readNode(file);
    const std::vector<osg::LightSource*> lights = find<osg::LightSource>(root);
    ASSERT_EQ(lights.size(), 3u);
    const osg::Light& sun = *lights[0]->getLight();
    EXPECT_EQ(sun.getPosition(), osg::Vec4(0, 0, 1, 0));
    EXPECT_NEAR(sun.getDiffuse().g(), .7354, 1e-4);
    EXPECT_NEAR(sun.getDiffuse().r(), 1.0, 1e-6);
    const osg::Light& bulb = *lights[1]->getLight();
    EXPECT_EQ(bulb.getName(), "bulb");
    EXPECT_EQ(bulb.getPosition(), osg::Vec4(0, 0, 0, 1));
    EXPECT_EQ(bulb.getQuadraticAttenuation(), 1.0f);
    EXPECT_EQ(bulb.getConstantAttenuation(), 0.0f);
    EXPECT_NEAR(bulb.getDiffuse().r(), 4.0, 1e-6);  // above 1 as it is
    const osg::Light& spot = *lights[2]->getLight();
    EXPECT_NEAR(spot.getSpotCutoff(), 60.0, 1e-4);
    EXPECT_NEAR(std::pow(std::cos(osg::PI / 3), spot.getSpotExponent()), .5, 1e-4);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(lights[std::size_t(i)]->getLight()->getLightNum(), i + 1);
        EXPECT_EQ(root->getStateSet()->getMode(GLenum(GL_LIGHT0 + i + 1)), osg::StateAttribute::ON);
    }
}

TEST(GltfScenes, Cameras)
{
    File file;
    file.show(file.triangle());
    file.document["cameras"] = {{{"type", "perspective"}, {"name", "lens"}, {"perspective", {{"yfov", osg::PI / 3}}}},
                                {{"type", "orthographic"}, {"name", "plan"}},
                                {{"type", "perspective"}, {"perspective", {{"yfov", osg::PI / 6}, {"aspectRatio", 2}}}}};
    for (int i = 0; i < 3; ++i) file.add("nodes", {{"name", "stand"}, {"camera", i}, {"translation", {0, i, 5}}});
    const osg::ref_ptr<osg::Node> root = readNode(file, "");
    const std::vector<osgEnvLight::ModelCamera> cameras = osgEnvLight::findModelCameras(*root);
    ASSERT_EQ(cameras.size(), 2u) << "the orthographic one is left out";
    EXPECT_EQ(cameras[0].name, "lens");
    EXPECT_NEAR(cameras[0].view.fovy, 60.0, 1e-9);
    expectNear(cameras[0].view.eye, osg::Vec3d(0, -5, 0));
    expectNear(cameras[0].view.up, osg::Vec3d(0, 0, 1));
    // Before the middle of the triangle from (0, 0, 0) to (1, 0, 1), in its plane.
    expectNear(cameras[0].view.target, osg::Vec3d(0, 0, 0));
    EXPECT_EQ(cameras[1].name, "stand");
    expectNear(cameras[1].view.eye, osg::Vec3d(0, -5, 2));
    EXPECT_NEAR(cameras[1].view.fovy, 30.0, 1e-9);
}

TEST(GltfScenes, TheFirstAnimationPlaysInALoop)
{
    const osg::ref_ptr<osg::Node> root =
        readNode(animated("translation", {1, 2, 3}, {0, 0, 0, 1, 0, 0, 3, 0, 0}, "VEC3", 3, "LINEAR"));
    auto* manager = dynamic_cast<osgAnimation::BasicAnimationManager*>(root->getUpdateCallback());
    ASSERT_TRUE(manager);
    ASSERT_EQ(manager->getAnimationList().size(), 1u);
    EXPECT_TRUE(manager->isPlaying("turn"));
    EXPECT_DOUBLE_EQ(manager->getAnimationList()[0]->getDuration(), 2.0);
    for (const auto& [time, x] : {std::pair(0.0, 0.0), {0.5, .5}, {1.5, 2.0}, {2.5, .5}}) {
        update(root, time);
        expectNear(placeOf(root), osg::Vec3d(x, 0, 0));
    }
}

TEST(GltfScenes, StepAndCubicInterpolation)
{
    osg::ref_ptr<osg::Node> root = readNode(animated("scale", {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3}, "VEC3", 3, "STEP"));
    update(root, 1.75);
    expectNear(placeOf(root, osg::Vec3d(1, 0, 0)), osg::Vec3d(2, 0, 0));

    // From 0 to 1 with tangents of 1 at the start and -2 at the end: 1.5 t + t^2 - 1.5 t^3 at t = 1/2, by the Hermite basis.
    const std::vector<float> keys = {0, 0, 0, 0, 0, 0, 1, 0, 0, -4, 0, 0, 1, 0, 0, 0, 0, 0};
    root = readNode(animated("translation", {0, 2}, keys, "VEC3", 3, "CUBICSPLINE"));
    update(root, 1.0);
    expectNear(placeOf(root), osg::Vec3d(.5 + .125 * 2 * 1 + .125 * 2 * 4, 0, 0));
}

TEST(GltfScenes, RotationsTurnAtConstantSpeed)
{
    const float h = float(std::sqrt(.5));
    for (const std::string interpolation : {"LINEAR", "CUBICSPLINE"}) {
        std::vector<float> keys = {0, 0, 0, 1, 0, 0, h, h};
        if (interpolation == "CUBICSPLINE") keys = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0};
        const osg::ref_ptr<osg::Node> root = readNode(animated("rotation", {0, 3}, keys, "VEC4", 4, interpolation.c_str()));
        update(root, 1.5);
        expectNear(placeOf(root, osg::Vec3d(1, 0, 0)), osg::Vec3d(h, h, 0));
        if (interpolation != "LINEAR") continue;
        update(root, 1.0);
        expectNear(placeOf(root, osg::Vec3d(1, 0, 0)), osg::Vec3d(std::cos(osg::PI / 6), .5, 0));
    }
}

TEST(GltfScenes, AnimatedWeights)
{
    for (const std::string interpolation : {"LINEAR", "STEP", "CUBICSPLINE"}) {
        const bool cubic = interpolation == "CUBICSPLINE";
        const std::vector<float> keys =
            cubic ? std::vector<float>{0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0} : std::vector<float>{0, 1, 1, 0};
        File file = animated("weights", {0, 1}, keys, "SCALAR", 1, interpolation.c_str());
        file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", file.vec3({8, 0, 0, 8, 0, 0, 8, 0, 0})}},
                                                                  {{"POSITION", file.vec3({0, 4, 0, 0, 4, 0, 0, 4, 0})}}};
        const osg::ref_ptr<osg::Node> root = readNode(file);
        update(root, .5);
        const osg::Geometry* g = geometryOf(root);
        const osg::Vec3 expected = interpolation == "STEP" ? osg::Vec3(0, 4, 0) : osg::Vec3(4, 2, 0);
        expectNear(arrayOf<osg::Vec3Array>(g->getVertexArray())[0], expected);
    }
}

namespace
{

/** Two joints, the second of which a quarter turn bends; the skinned node's own transform counts for nothing. */
File skinned()
{
    File file;
    json primitive = {
        {"attributes",
         {{"POSITION", file.vec3({0, 0, 0, 0, 1, 0, 0, 2, 0})},
          {"NORMAL", file.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0})},
          {"JOINTS_0", file.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, kUByte, "VEC4", 4)},
          {"WEIGHTS_0", file.vec4({1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0})}}}};
    file.show(primitive);
    file.document["nodes"][0].update({{"skin", 0}, {"translation", {100, 0, 0}}});
    const float h = float(std::sqrt(.5));
    file.add("nodes", {{"name", "armature"}, {"children", {2}}, {"translation", {0, 0, 5}}});
    file.add("nodes", {{"name", "hip"}, {"children", {3}}});
    file.add("nodes", {{"name", "knee"}, {"translation", {0, 1, 0}}, {"rotation", {0, 0, h, h}}});
    const int matrices = file.accessor(
        std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
        kFloat, "MAT4", 16);
    file.add("skins", {{"joints", {2, 3}}, {"inverseBindMatrices", matrices}});
    return file;
}

}  // namespace

TEST(GltfScenes, SkinsFollowTheirJoints)
{
    const osg::ref_ptr<osg::Node> root = readNode(skinned());
    const std::vector<osgAnimation::RigGeometry*> rigs = find<osgAnimation::RigGeometry>(root);
    ASSERT_EQ(rigs.size(), 1u);
    // At once, before a viewer updates it.
    for (int round = 0; round < 2; ++round) {
        const osg::Vec3Array& v = arrayOf<osg::Vec3Array>(rigs[0]->getVertexArray());
        expectNear(v[0], osg::Vec3d(0, 0, 5));
        expectNear(v[1], osg::Vec3d(0, 1, 5));
        expectNear(v[2], osg::Vec3d(-1, 1, 5));
        expectNear(arrayOf<osg::Vec3Array>(rigs[0]->getNormalArray())[2], osg::Vec3d(0, 1, 0));
        update(root, 1.0);
    }
    EXPECT_LT(root->getBound().radius(), 10.0);
}

TEST(GltfScenes, AnimatedJointsAndMorphTargetsTogether)
{
    File file = skinned();
    file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", file.vec3({0, 0, 0, 0, 0, 0, 0, 2, 0})}}};
    const float h = float(std::sqrt(.5));
    const int input = file.scalars({0, 1});
    file.add("animations", {{"samplers",
                             {{{"input", input}, {"output", file.vec4({0, 0, h, h, 0, 0, -h, h})}},
                              {{"input", input}, {"output", file.scalars({0, 1})}}}},
                            {"channels",
                             {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "rotation"}}}},
                              {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    const osg::ref_ptr<osg::Node> root = readNode(file);
    const std::vector<osgAnimation::RigGeometry*> rigs = find<osgAnimation::RigGeometry>(root);
    ASSERT_EQ(rigs.size(), 1u);
    update(root, .999);
    expectNear(arrayOf<osg::Vec3Array>(rigs[0]->getVertexArray())[2], osg::Vec3d(3, 1, 5), .01);
}
