// SPDX-License-Identifier: MIT
#include "SuiteScenes.h"

#include "Suite.h"

#include <osg/AnimationPath>
#include <osg/Geometry>

#include <osgDB/FileUtils>
#include <osgDB/ReadFile>

#include <cmath>
#include <map>
#include <stdexcept>

namespace suite
{

using osg::Vec3d;
using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

SuiteScene emptyScene()
{
    SuiteScene scene;
    scene.lit = new LitScene;
    return scene;
}

// A term is rendered some frames after the picture: what moves would be elsewhere.
class StandStill : public osg::NodeVisitor
{
  public:
    StandStill() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override
    {
        if (auto* animation = dynamic_cast<osg::AnimationPathCallback*>(node.getUpdateCallback())) animation->setPause(true);
        traverse(node);
    }
};

SuiteScene demonstration(const std::string& name)
{
    SuiteScene scene;
    const std::string file = std::string(ENVLIGHT_BINARY_DIR "/scenes/") + name + ".envlight";
    if (!osgDB::fileExists(file)) return scene;
    scene.lit = dynamic_cast<LitScene*>(osgDB::readRefNodeFile(file).get());
    if (!scene.lit || !scene.lit->getHomeView()) throw std::runtime_error(file + ": no scene with a view");
    StandStill still;
    scene.lit->accept(still);
    scene.eye = scene.lit->getHomeView()->eye;
    scene.target = scene.lit->getHomeView()->target;
    scene.fovy = scene.lit->getHomeView()->fovy;
    return scene;
}

struct Model {
    const char* file;
    Vec3d towardsEye;
};

class Vertices : public osg::NodeVisitor
{
  public:
    Vertices() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Geometry& geometry) override
    {
        const osg::Matrixd worldFromLocal = osg::computeLocalToWorld(getNodePath());
        if (const auto* vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray()))
            for (const osg::Vec3& v : *vertices) world.push_back(Vec3d(v) * worldFromLocal);
    }

    std::vector<Vec3d> world;
};

// The nearest eye from which a view along -towards, with +Z up, has all vertices inside its middle nine tenths.
void fitView(osg::Node& node, const Vec3d& towards, SuiteScene& scene)
{
    Vertices vertices;
    node.accept(vertices);
    Vec3d back = towards;
    back.normalize();
    Vec3d axes[2] = {Vec3d(0, 0, 1) ^ back, Vec3d()};
    axes[0].normalize();
    axes[1] = back ^ axes[0];
    const double tangent = 0.9 * std::tan(osg::DegreesToRadians(0.5 * scene.fovy));
    const double slopes[2] = {tangent * width / height, tangent};
    double distance = 0.0;
    scene.eye = Vec3d();
    for (int k = 0; k < 2; ++k) {
        // v lies between the planes |v . axis - eye . axis| = slope (eye . back - v . back).
        double left = -1e30, right = -1e30;
        for (const Vec3d& v : vertices.world) {
            left = std::max(left, slopes[k] * (v * back) - v * axes[k]);
            right = std::max(right, slopes[k] * (v * back) + v * axes[k]);
        }
        scene.eye += axes[k] * (0.5 * (right - left));
        distance = std::max(distance, 0.5 * (right + left) / slopes[k]);
    }
    scene.eye += back * distance;
    scene.target = scene.eye - back;
}

SuiteScene modelScene(const Model& model)
{
    const std::string file = std::string("/usr/share/assimp/models/") + model.file;
    if (!osgDB::fileExists(file)) return SuiteScene();
    SuiteScene scene = emptyScene();
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
    if (!node) throw std::runtime_error(file + ": OpenSceneGraph can't read it");
    scene.lit->addChild(node);
    fitView(*node, model.towardsEye, scene);
    return scene;
}

const std::map<std::string, Model> models = {{"spider", {"OBJ/spider.obj", Vec3d(0.7, -1, 0.8)}},
                                             {"wuson", {"PLY/Wuson.ply", Vec3d(0.6, 0.5, 1)}},
                                             {"fels", {"3DS/fels.3ds", Vec3d(0.6, -1, 0.7)}}};

}  // namespace

SuiteScene makeScene(const std::string& name)
{
    SuiteScene scene;
    const auto model = models.find(name);
    if (model != models.end())
        scene = modelScene(model->second);
    else if (name == "chess" || name == "atrium" || name == "swing" || name == "spheres" || name == "cornell")
        scene = demonstration(name);
    else {
        scene = emptyScene();
        buildScene(name, scene);
        if (scene.lit->getNumChildren() == 0) throw std::runtime_error(name + ": no scene of the suite");
    }
    if (scene.lit) {
        scene.lit->getSettings()->output = Settings::LINEAR;
        scene.lit->getSettings()->regeneration = Settings::IMMEDIATE;
    }
    return scene;
}

bool setMap(LitScene& lit, const std::string& name)
{
    osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    if (name == "lamps") {
        map.setImage(makeMap(256, 128, [](const Vec3d& d) {
                         const double red = std::exp(60.0 * (d * Vec3d(0.77, -0.23, 0.6) - 1.0));
                         const double blue = std::exp(60.0 * (d * Vec3d(-0.8, 0.0, 0.6) - 1.0));
                         return Vec3d(0.05, 0.05, 0.05) + Vec3d(10.0, 1.0, 0.5) * red + Vec3d(0.5, 1.5, 10.0) * blue;
                     }).get());
        return true;
    }
    const bool builtIn = name == "sky" || name == "studio";
    const std::string file = builtIn ? name : "/usr/share/blender/datafiles/studiolights/world/" + name + ".exr";
    if (!builtIn && !osgDB::fileExists(file)) return false;
    std::string error;
    if (!map.load(file, nullptr, error)) throw std::runtime_error(error);
    return true;
}

}  // namespace suite
