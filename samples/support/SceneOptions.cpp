// SPDX-License-Identifier: MIT
#include "SceneOptions.h"

#include <osgEnvLight/ModelCameras>
#include <osgEnvLight/SceneDescription>

#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/fstream>
#include <osgGA/TrackballManipulator>

#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace
{

osg::Vec3d vector(const std::vector<double>& v)
{
    return osg::Vec3d(v[0], v[1], v[2]);
}

osg::ref_ptr<osgEnvLight::LitScene> loadScene(const std::string& name)
{
    const std::string pseudo = osgDB::getLowerCaseFileExtension(name) == "envlight" ? name : name + ".envlight";
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(pseudo, nullptr);
    osg::ref_ptr<osgEnvLight::LitScene> lit = dynamic_cast<osgEnvLight::LitScene*>(result.getNode());
    if (lit) return lit;
    throw std::runtime_error(result.message().empty() ? name + ": the plugin osgdb_envlight is not found on OSG_LIBRARY_PATH"
                                                      : result.message());
}

}  // namespace

void SceneOptions::addTo(CommandLine& line)
{
    CommandLine::Option file = line.add("SCENE", scene, "a model, or a scene description (.envlight)");
    if (interactive)
        line.add("MAP", map, "environment map, as --env");
    else
        file.required();
    line.add("--env", map, "environment map: a file, sky or studio");
    line.add("--env-layout", layout, "layout of the map where its shape does not say it: " + osgEnvLight::mapLayoutChoices());
    line.add("--env-rotation", rotation, "degrees, counter-clockwise about +Z");
    line.add("--env-intensity", intensity, "a factor for the map's radiance").within(0.0, 1e12);
    line.add("--camera", camera, "a camera of the model by its name, or one from a JSON file");
    line.add("--eye", eye, "x,y,z").separatedBy(',').ofValues(3);
    line.add("--target", target, "x,y,z").separatedBy(',').ofValues(3);
    line.add("--up", up, "x,y,z").separatedBy(',').ofValues(3);
    line.add("--fovy", fovy, "vertical opening angle, degrees").within(0.01, 179.0);
    line.add("--size", size, "WIDTHxHEIGHT, default " + size);
    line.add("--set", settings,
             "name=value of a property of Settings (switches take on | off), or preset=low | default | high | interior; "
             "repeatable")
        .repeatable();
}

void SceneOptions::check()
{
    char x = 0;
    std::string rest;
    std::istringstream in(size);
    in.imbue(std::locale::classic());
    if (!(in >> width >> x >> height) || x != 'x' || (in >> rest) || width < 1 || height < 1 || width > 16384 || height > 16384)
        throw BadArguments("--size is '" + size + "', expected WIDTHxHEIGHT, each 1..16384");
}

osg::ref_ptr<osgEnvLight::LitScene> SceneOptions::load(bool linear) const
{
    osg::ref_ptr<osgEnvLight::LitScene> lit;
    if (scene.empty())
        lit = new osgEnvLight::LitScene;
    else
        lit = loadScene(scene);
    std::string error;
    osgEnvLight::EnvironmentMap& environment = *lit->getEnvironmentMap();
    // A scene's layout is that of its own map.
    osgEnvLight::MapLayout mapLayout = map.empty() ? environment.getLayout() : osgEnvLight::MapLayout::AUTO;
    if (!layout.empty() && !osgEnvLight::mapLayoutFromName(layout, mapLayout))
        throw BadArguments("--env-layout is '" + layout + "', expected one of " + osgEnvLight::mapLayoutChoices());
    environment.setLayout(mapLayout);
    if (!map.empty() && !environment.load(map, nullptr, error)) throw std::runtime_error(error);
    if (rotation) environment.setRotation(*rotation);
    if (intensity) environment.setIntensity(*intensity);
    lit->getSettings()->output = linear ? osgEnvLight::Settings::LINEAR : osgEnvLight::Settings::DISPLAY;
    if (!interactive) {  // one frame is all that the others show
        lit->getSettings()->regeneration = osgEnvLight::Settings::IMMEDIATE;
        lit->getSettings()->adaptationTime = 0.0f;
    }
    applySettings(*lit->getSettings());
    if (!environment.radiance(error)) throw std::runtime_error(error);
    return lit;
}

void SceneOptions::applySettings(osgEnvLight::Settings& changed) const
{
    std::string error;
    for (const std::string& s : settings) {
        const size_t equals = s.find('=');
        if (equals == std::string::npos) throw BadArguments("--set is '" + s + "', expected name=value");
        if (!changed.set(s.substr(0, equals), s.substr(equals + 1), error)) throw BadArguments(error);
    }
}

osgEnvLight::HomeView SceneOptions::namedView(osgEnvLight::LitScene& lit) const
{
    osgEnvLight::HomeView view;
    std::string error;
    osgDB::ifstream in(camera.c_str(), std::ios::binary);
    if (!in) {
        try {
            return osgEnvLight::modelCamera(lit, camera);
        } catch (const std::exception& e) {
            throw std::runtime_error("--camera is " + std::string(e.what()) + ", or a JSON file");
        }
    }
    if (!osgEnvLight::readCamera(in, camera, view, error)) throw std::runtime_error(error);
    return view;
}

std::optional<osgEnvLight::HomeView> SceneOptions::chosenView(osgEnvLight::LitScene& lit) const
{
    std::optional<osgEnvLight::HomeView> view = lit.getHomeView();
    if (!camera.empty()) view = namedView(lit);
    if (eye.empty() != target.empty()) throw BadArguments("--eye and --target go together");
    if (!eye.empty()) {
        view.emplace();
        view->eye = vector(eye);
        view->target = vector(target);
    }
    if (view && !up.empty()) view->up = vector(up);
    if (view && fovy) view->fovy = *fovy;
    return view;
}

double SceneOptions::openingAngle() const
{
    const osg::DisplaySettings& screen = *osg::DisplaySettings::instance();
    return fovy ? *fovy
                : osg::RadiansToDegrees(2.0 * std::atan2(0.5 * screen.getScreenHeight(), double(screen.getScreenDistance())));
}

osgEnvLight::HomeView SceneOptions::view(osgEnvLight::LitScene& lit) const
{
    if (const auto chosen = chosenView(lit)) return *chosen;
    // Without a view of its own a scene is seen as osgviewer starts: the opening angle of a screen as DisplaySettings
    // gives it, and the manipulator's home.
    osgEnvLight::HomeView home;
    home.fovy = openingAngle();
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setProjectionMatrixAsPerspective(home.fovy, double(width) / height, 1.0, 10000.0);
    osg::ref_ptr<osgGA::TrackballManipulator> manipulator = new osgGA::TrackballManipulator;
    manipulator->setNode(&lit);
    manipulator->computeHomePosition(camera, false);
    manipulator->getHomePosition(home.eye, home.target, home.up);
    return home;
}

void SceneOptions::setCamera(const osgEnvLight::HomeView& view, osg::Camera& camera) const
{
    camera.setProjectionMatrixAsPerspective(view.fovy, double(width) / height, 1.0, 10000.0);
    camera.setViewMatrixAsLookAt(view.eye, view.target, view.up);
}
