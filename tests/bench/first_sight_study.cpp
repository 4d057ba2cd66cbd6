// SPDX-License-Identifier: MIT
// envlight_first_sight_study DIR MODEL...: what a user sees first. For each model DIR/<n>-<model>.png, side by side: plain
// OpenSceneGraph as osgviewer shows it, then lit by `sky`, `studio` and each map named in ENVLIGHT_STUDY_MAPS (folders and
// files separated by ':'), all with default settings from osgviewer's home position.
#include <SceneRenderer.h>

#include <osg/Material>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace
{

const int side = 320;

// osgviewer's own state above the scene.
void setViewerState(osg::Camera& camera)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    camera.getOrCreateStateSet()->setAttributeAndModes(material);
    camera.setClearColor(osg::Vec4(0.2f, 0.2f, 0.4f, 1.0f));
}

void lookFromHome(SceneRenderer& renderer, const osg::Node& scene)
{
    const osg::BoundingSphere bound = scene.getBound();
    const double distance = 3.5 * double(bound.radius());
    renderer.lookAt(bound.center() + osg::Vec3d(0, -distance, 0), bound.center(), osg::Vec3d(0, 0, 1), 29.148);
}

osg::ref_ptr<osg::Image> eightBits(const Picture& picture)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int k = 0; k < 3; ++k) {
                const double value = std::clamp(picture.color(x, y)[k], 0.0, 1.0);
                *(image->data(unsigned(x), unsigned(y)) + k) = static_cast<unsigned char>(std::lround(255.0 * value));
            }
    return image;
}

Picture show(osg::Node* scene)
{
    SceneRenderer renderer(side, side);
    setViewerState(*renderer.viewer().getCamera());
    lookFromHome(renderer, *scene);
    return renderer.render(scene, 3);
}

std::vector<std::string> mapNames()
{
    std::vector<std::string> maps = {"sky", "studio"};
    const char* more = std::getenv("ENVLIGHT_STUDY_MAPS");
    osgDB::FilePathList list;
    if (more) osgDB::convertStringPathIntoFilePathList(more, list);
    maps.insert(maps.end(), list.begin(), list.end());
    return maps;
}

// Each picture from a model of its own: OSG's data give their images away when they are first drawn.
osg::ref_ptr<osg::Image> row(const std::string& model, const std::vector<std::string>& maps)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(side * int(maps.size() + 1), side, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    for (size_t i = 0; i <= maps.size(); ++i) {
        osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(model);
        if (!node) return nullptr;
        if (i > 0) {
            osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene;
            std::string error;
            if (!lit->getEnvironmentMap()->load(maps[i - 1], nullptr, error)) std::cerr << error << "\n";
            lit->addChild(node);
            node = lit;
        }
        image->copySubImage(int(i) * side, 0, 0, eightBits(show(node)));
    }
    return image;
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        std::cerr << "usage: envlight_first_sight_study DIR MODEL...\n";
        return 2;
    }
    const std::vector<std::string> maps = mapNames();
    for (int i = 2; i < argc; ++i) {
        const osg::ref_ptr<osg::Image> image = row(argv[i], maps);
        const std::string name =
            std::string(argv[1]) + "/" + std::to_string(i - 1) + "-" + osgDB::getSimpleFileName(argv[i]) + ".png";
        if (!image || !osgDB::writeImageFile(*image, name)) std::cerr << argv[i] << ": no picture\n";
    }
    return 0;
}
