// SPDX-License-Identifier: MIT
#include "SuiteScenes.h"

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

SuiteScene demonstration(const std::string& name)
{
    SuiteScene scene;
    const std::string file = std::string(ENVLIGHT_BINARY_DIR "/scenes/") + name + ".envlight";
    scene.lit = dynamic_cast<LitScene*>(osgDB::readRefNodeFile(file).get());
    if (!scene.lit || !scene.lit->getHomeView()) throw std::runtime_error(file + ": no scene with a view; is it built?");
    scene.eye = scene.lit->getHomeView()->eye;
    scene.target = scene.lit->getHomeView()->target;
    scene.fovy = scene.lit->getHomeView()->fovy;
    return scene;
}

struct Model {
    const char* file;
    Vec3d towardsEye;  // from the middle of the model
};

// Seen from so far that its bounding sphere fills the view.
SuiteScene modelScene(const Model& model)
{
    const std::string file = std::string("/usr/share/assimp/models/") + model.file;
    if (!osgDB::fileExists(file)) return SuiteScene();
    SuiteScene scene = emptyScene();
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
    if (!node) throw std::runtime_error(file + ": OpenSceneGraph can't read it");
    scene.lit->addChild(node);
    const osg::BoundingSphere bound = node->getBound();
    Vec3d towards = model.towardsEye;
    towards.normalize();
    scene.target = bound.center();
    scene.eye = scene.target + towards * (double(bound.radius()) / std::sin(osg::DegreesToRadians(0.5 * scene.fovy)));
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
    else if (name == "chess" || name == "atrium" || name == "swing" || name == "spheres")
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
