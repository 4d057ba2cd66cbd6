// SPDX-License-Identifier: MIT
// The glTF reader: containers, accessors, primitives, morph targets.
#include "GltfFiles.h"

#include <osgEnvLight/Material>

#include <osgAnimation/MorphGeometry>

using namespace gltffiles;

namespace
{

osg::Vec3 vertex(osg::Geometry* g, unsigned i)
{
    const osg::Vec3Array& array = arrayOf<osg::Vec3Array>(g->getVertexArray());
    return i < array.size() ? array[i] : osg::Vec3();
}

}  // namespace

TEST(GltfMeshes, TextAndBinaryAreTheSame)
{
    File file;
    file.show(file.triangle());
    for (const std::string& text : {file.text(), file.binary()}) {
        const osg::ref_ptr<osg::Node> node = readNode(text);
        osg::Geometry* g = geometryOf(node);
        ASSERT_TRUE(g);
        EXPECT_EQ(vertex(g, 1), osg::Vec3(1, 0, 0));
        EXPECT_EQ(g->getNumPrimitiveSets(), 1u);
        EXPECT_EQ(g->getPrimitiveSet(0)->getMode(), GLenum(GL_TRIANGLES));
        EXPECT_FALSE(g->getNormalArray());
    }
}

TEST(GltfMeshes, EveryModeIsOpenGls)
{
    for (const int mode : {GL_POINTS, GL_LINES, GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN}) {
        File file;
        json primitive = file.triangle();
        primitive["mode"] = mode;
        file.show(primitive);
        const osg::ref_ptr<osg::Node> node = readNode(file);
        osg::Geometry* g = geometryOf(node);
        ASSERT_TRUE(g);
        EXPECT_EQ(int(g->getPrimitiveSet(0)->getMode()), mode);
        EXPECT_EQ(trianglesOf(*g), mode >= GL_TRIANGLES ? 1 : 0);
        // Without faces and normals there is no light.
        EXPECT_EQ(g->getStateSet()->getMode(GL_LIGHTING) == osg::StateAttribute::OFF, mode < GL_TRIANGLES);
    }
}

TEST(GltfMeshes, IndicesOfEverySize)
{
    const auto indexOf = [](int accessor, File& file) {
        json primitive = file.triangle();
        primitive["indices"] = accessor;
        file.show(primitive);
        const osg::ref_ptr<osg::Node> node = readNode(file);
        osg::Geometry* g = geometryOf(node);
        EXPECT_EQ(g->getPrimitiveSet(0)->getNumIndices(), 3u);
        EXPECT_EQ(g->getPrimitiveSet(0)->index(0), 2u);
        return g->getPrimitiveSet(0)->getType();
    };
    File bytes, shorts, ints;
    EXPECT_EQ(indexOf(bytes.accessor(std::vector<std::uint8_t>{2, 1, 0}, kUByte, "SCALAR", 1), bytes),
              osg::PrimitiveSet::DrawElementsUShortPrimitiveType);
    EXPECT_EQ(indexOf(shorts.accessor(std::vector<std::uint16_t>{2, 1, 0}, kUShort, "SCALAR", 1), shorts),
              osg::PrimitiveSet::DrawElementsUShortPrimitiveType);
    EXPECT_EQ(indexOf(ints.accessor(std::vector<std::uint32_t>{2, 1, 0}, kUInt, "SCALAR", 1), ints),
              osg::PrimitiveSet::DrawElementsUIntPrimitiveType);
}

TEST(GltfMeshes, AttributesGoWhereTheyAreDocumented)
{
    File file;
    json primitive = file.triangle();
    primitive["attributes"]["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["attributes"]["TANGENT"] = file.vec4({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1});
    primitive["attributes"]["TEXCOORD_0"] = file.vec2({0, 0, 1, 0, 0, .25f});
    primitive["attributes"]["TEXCOORD_1"] = file.vec2({0, 0, 1, 0, 0, .75f});
    file.show(primitive);
    const osg::ref_ptr<osg::Node> node = readNode(file);
    osg::Geometry* g = geometryOf(node);
    ASSERT_TRUE(g);
    EXPECT_EQ(arrayOf<osg::Vec3Array>(g->getNormalArray())[2], osg::Vec3(0, 0, 1));
    EXPECT_EQ(arrayOf<osg::Vec4Array>(g->getVertexAttribArray(6))[0], osg::Vec4(1, 0, 0, -1));
    EXPECT_EQ(arrayOf<osg::Vec2Array>(g->getTexCoordArray(0))[2].y(), .25f);
    EXPECT_EQ(arrayOf<osg::Vec2Array>(g->getTexCoordArray(1))[2].y(), .75f);
    EXPECT_EQ(g->getVertexAttribArray(6)->getBinding(), osg::Array::BIND_PER_VERTEX);
}

TEST(GltfMeshes, EveryComponentType)
{
    const auto y = [](int accessor, File& file) {
        file.show({{"attributes", {{"POSITION", accessor}}}});
        const osg::ref_ptr<osg::Node> node = readNode(file);
        return vertex(geometryOf(node), 0).y();
    };
    File files[10];
    EXPECT_FLOAT_EQ(y(files[0].accessor(std::vector<std::int8_t>{0, -7, 0, 0}, kByte, "VEC3", 4), files[0]), -7.0f);
    EXPECT_FLOAT_EQ(y(files[1].accessor(std::vector<std::uint8_t>{0, 200, 0, 0}, kUByte, "VEC3", 4), files[1]), 200.0f);
    EXPECT_FLOAT_EQ(y(files[2].accessor(std::vector<std::int16_t>{0, -700, 0}, kShort, "VEC3", 3), files[2]), -700.0f);
    EXPECT_FLOAT_EQ(y(files[3].accessor(std::vector<std::uint16_t>{0, 60000, 0}, kUShort, "VEC3", 3), files[3]), 60000.0f);
    EXPECT_FLOAT_EQ(y(files[4].accessor(std::vector<std::uint32_t>{0, 1u << 31, 0}, kUInt, "VEC3", 3), files[4]), 2147483648.0f);
    EXPECT_FLOAT_EQ(y(files[5].accessor(std::vector<std::int8_t>{0, -128, 0, 0}, kByte, "VEC3", 4, true), files[5]), -1.0f);
    EXPECT_FLOAT_EQ(y(files[6].accessor(std::vector<std::uint8_t>{0, 51, 0, 0}, kUByte, "VEC3", 4, true), files[6]), .2f);
    EXPECT_FLOAT_EQ(y(files[7].accessor(std::vector<std::int16_t>{0, 32767, 0}, kShort, "VEC3", 3, true), files[7]), 1.0f);
    EXPECT_FLOAT_EQ(y(files[8].accessor(std::vector<std::uint16_t>{0, 13107, 0}, kUShort, "VEC3", 3, true), files[8]), .2f);
    EXPECT_FLOAT_EQ(y(files[9].vec3({0, .3f, 0}), files[9]), .3f);
}

TEST(GltfMeshes, StridesAndOffsets)
{
    File file;
    // Position and another float, interleaved, after four bytes.
    file.view(bytesOf(std::vector<float>{9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}), 16);
    file.add("accessors", {{"bufferView", 0}, {"byteOffset", 4}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}});
    file.show({{"attributes", {{"POSITION", 0}}}});
    const osg::ref_ptr<osg::Node> node = readNode(file);
    osg::Geometry* g = geometryOf(node);
    EXPECT_EQ(vertex(g, 1), osg::Vec3(1, 0, 0));
    EXPECT_EQ(vertex(g, 2), osg::Vec3(0, 1, 0));
}

TEST(GltfMeshes, SparseAccessors)
{
    for (const bool based : {true, false}) {
        File file;
        const int indices = file.view(bytesOf(std::vector<std::uint16_t>{1}));
        const int values = file.view(bytesOf(std::vector<float>{5, 6, 7}));
        json accessor = {{"componentType", kFloat},
                         {"count", 3},
                         {"type", "VEC3"},
                         {"sparse",
                          {{"count", 1},
                           {"indices", {{"bufferView", indices}, {"componentType", kUShort}}},
                           {"values", {{"bufferView", values}}}}}};
        if (based) accessor["bufferView"] = file.view(bytesOf(std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3}));
        file.show({{"attributes", {{"POSITION", file.add("accessors", accessor)}}}});
        const osg::ref_ptr<osg::Node> node = readNode(file);
        osg::Geometry* g = geometryOf(node);
        EXPECT_EQ(vertex(g, 0), based ? osg::Vec3(1, 1, 1) : osg::Vec3());
        EXPECT_EQ(vertex(g, 1), osg::Vec3(5, 6, 7));
    }
}

TEST(GltfMeshes, VertexColorsBecomeDisplayValues)
{
    File file;
    json primitive = file.triangle();
    primitive["attributes"]["COLOR_0"] = file.vec3({0, .5f, 1, 0, .5f, 1, 0, .5f, 1});
    primitive["material"] =
        file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, .25, .5}}}}, {"alphaMode", "BLEND"}});
    file.show(primitive);
    const osg::ref_ptr<osg::Node> node = readNode(file);
    osg::Geometry* g = geometryOf(node);
    const osg::Vec4 c = arrayOf<osg::Vec4Array>(g->getColorArray())[0];
    EXPECT_NEAR(c.r(), 0.0, 1e-4);
    EXPECT_NEAR(c.g(), 0.7354, 1e-4);  // .5 encoded
    EXPECT_NEAR(c.b(), 0.5371, 1e-4);  // .25 encoded
    EXPECT_FLOAT_EQ(c.a(), .5f);
    // It is as metallic and rough as one without.
    EXPECT_EQ(osgEnvLight::Material::COOK_TORRANCE, osgEnvLight::Material::brdfOf(*g->getStateSet(), -1));
    bool taken = false;
    ASSERT_TRUE(g->getStateSet()->getUniform("envlightVertexColors"));
    EXPECT_TRUE(g->getStateSet()->getUniform("envlightVertexColors")->get(taken) && taken);
}

TEST(GltfMeshes, NodesShareTheirMesh)
{
    File file;
    file.show(file.triangle());
    file.add("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    const osg::ref_ptr<osg::Node> node = readNode(file);
    const std::vector<osg::Geometry*> all = find<osg::Geometry>(node);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0], all[1]);
}

TEST(GltfMeshes, GpuInstances)
{
    File file;
    const int node = file.show(file.triangle());
    file.document["nodes"][std::size_t(node)]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.vec3({1, 0, 0, 2, 0, 0, 3, 0, 0})}, {"SCALE", file.vec3({1, 1, 1, 2, 2, 2, 1, 1, 1})}};
    const osg::ref_ptr<osg::Node> root = readNode(file);
    const std::vector<osg::Geode*> geodes = find<osg::Geode>(root);
    ASSERT_EQ(geodes.size(), 3u);
    EXPECT_EQ(geodes[0], geodes[2]);
    ASSERT_EQ(geodes[0]->getWorldMatrices().size(), 3u);
    EXPECT_EQ(osg::Vec3d(1, 0, 0) * geodes[0]->getWorldMatrices()[1], osg::Vec3d(4, 0, 0));
}

TEST(GltfMeshes, MorphTargetsBeginWithTheirWeights)
{
    File file;
    json primitive = file.triangle();
    primitive["attributes"]["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["targets"] = {
        {{"POSITION", file.vec3({0, 0, 2, 0, 0, 2, 0, 0, 2})}, {"NORMAL", file.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0})}},
        {{"POSITION", file.vec3({0, 0, 9, 0, 0, 9, 0, 0, 9})}, {"NORMAL", file.vec3({0, 0, 0, 0, 0, 0, 0, 0, 0})}}};
    file.show(primitive);
    file.document["meshes"][0]["weights"] = {0.5, 0.0};
    file.add("nodes", {{"mesh", 0}, {"weights", {1.0, 0.0}}});
    const osg::ref_ptr<osg::Node> node = readNode(file);
    const std::vector<osg::Geometry*> all = find<osg::Geometry>(node);
    ASSERT_EQ(all.size(), 2u);
    ASSERT_TRUE(dynamic_cast<osgAnimation::MorphGeometry*>(all[0]));
    EXPECT_NE(all[0], all[1]);
    EXPECT_EQ(vertex(all[0], 1), osg::Vec3(1, 0, 1));
    EXPECT_EQ(vertex(all[1], 1), osg::Vec3(1, 0, 2));
    EXPECT_NEAR(arrayOf<osg::Vec3Array>(all[1]->getNormalArray())[0].x(), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(node->getBound().center().z(), 1.0, 0.6);  // about the morphed ones
}
