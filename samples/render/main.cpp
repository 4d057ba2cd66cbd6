// SPDX-License-Identifier: MIT
// envlight-render: a scene lit by its environment, to an image, without an X server.
#include "CommandLine.h"
#include "HeadlessContext.h"
#include "ImageFile.h"
#include "PluginPath.h"
#include "Statistics.h"

#include <osgEnvLight/SceneDescription>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/fstream>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

#include <chrono>
#include <cmath>
#include <iostream>
#include <stdexcept>

namespace
{

struct Arguments {
    std::string scene;
    std::string output;
    std::string map;
    std::string layout;
    std::optional<double> rotation;
    std::string cameraFile;
    std::vector<double> eye;
    std::vector<double> target;
    std::vector<double> up;
    std::optional<double> fovy;
    std::string size = "512x512";
    std::vector<std::string> settings;
    std::string term;
    int frames = 2;  // the second has all textures and shaders
    std::string statistics;
    int width = 0;
    int height = 0;
};

void parseSize(Arguments& a)
{
    char x = 0;
    std::string rest;
    std::istringstream in(a.size);
    in.imbue(std::locale::classic());
    if (!(in >> a.width >> x >> a.height) || x != 'x' || (in >> rest) || a.width < 1 || a.height < 1 || a.width > 16384 ||
        a.height > 16384)
        throw BadArguments("--size is '" + a.size + "', expected WIDTHxHEIGHT, each 1..16384");
}

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

void applyOptions(const Arguments& a, osgEnvLight::LitScene& lit)
{
    std::string error;
    osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    // A scene's layout is that of its own map.
    osgEnvLight::MapLayout layout = a.map.empty() ? map.getLayout() : osgEnvLight::MapLayout::AUTO;
    if (!a.layout.empty() && !osgEnvLight::mapLayoutFromName(a.layout, layout))
        throw BadArguments("--env-layout is '" + a.layout + "', expected one of " + osgEnvLight::mapLayoutChoices());
    map.setLayout(layout);
    if (!a.map.empty() && !map.load(a.map, nullptr, error)) throw std::runtime_error(error);
    if (a.rotation) map.setRotation(*a.rotation);
    std::vector<std::string> settings = a.settings;
    if (!a.term.empty()) settings.push_back("view=" + a.term);
    const bool linear = osgDB::getLowerCaseFileExtension(a.output) == "exr";
    settings.insert(settings.begin(), std::string("output=") + (linear ? "linear" : "display"));
    for (const std::string& s : settings) {
        const size_t equals = s.find('=');
        if (equals == std::string::npos) throw BadArguments("--set is '" + s + "', expected name=value");
        if (!lit.getSettings()->set(s.substr(0, equals), s.substr(equals + 1), error)) throw BadArguments(error);
    }
    if (!map.radiance(error)) throw std::runtime_error(error);
}

// The camera of the command line, else the scene's, else null: OSG's home position.
std::optional<osgEnvLight::HomeView> chosenView(const Arguments& a, const osgEnvLight::LitScene& lit)
{
    std::optional<osgEnvLight::HomeView> view = lit.getHomeView();
    if (!a.cameraFile.empty()) {
        view.emplace();
        std::string error = a.cameraFile + ": can't be read";
        osgDB::ifstream in(a.cameraFile.c_str(), std::ios::binary);
        if (!in || !osgEnvLight::readCamera(in, a.cameraFile, *view, error)) throw std::runtime_error(error);
    }
    if (a.eye.empty() != a.target.empty()) throw BadArguments("--eye and --target go together");
    if (!a.eye.empty()) {
        view.emplace();
        view->eye = vector(a.eye);
        view->target = vector(a.target);
    }
    if (view && !a.up.empty()) view->up = vector(a.up);
    if (view && a.fovy) view->fovy = *a.fovy;
    return view;
}

void setCamera(const Arguments& a, const osgEnvLight::LitScene& lit, osgViewer::Viewer& viewer)
{
    const double aspect = double(a.width) / a.height;
    const auto view = chosenView(a, lit);
    osg::Camera& camera = *viewer.getCamera();
    // Without a view of its own a scene is seen as osgviewer starts: the opening angle of a screen as DisplaySettings
    // gives it, and the manipulator's home.
    const osg::DisplaySettings& screen = *osg::DisplaySettings::instance();
    double fovy = osg::RadiansToDegrees(2.0 * std::atan2(0.5 * screen.getScreenHeight(), double(screen.getScreenDistance())));
    if (view) fovy = view->fovy;
    if (a.fovy) fovy = *a.fovy;
    camera.setProjectionMatrixAsPerspective(fovy, aspect, 1.0, 10000.0);
    if (view) {
        camera.setViewMatrixAsLookAt(view->eye, view->target, view->up);
        return;
    }
    osg::ref_ptr<osgGA::TrackballManipulator> manipulator = new osgGA::TrackballManipulator;
    manipulator->setNode(const_cast<osgEnvLight::LitScene*>(&lit));
    manipulator->computeHomePosition(&camera, false);
    osg::Vec3d eye, target, up;
    manipulator->getHomePosition(eye, target, up);
    camera.setViewMatrixAsLookAt(eye, target, up);
}

osg::ref_ptr<osg::Image> render(const Arguments& a, osgEnvLight::LitScene& lit, Statistics& statistics)
{
    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window = viewer.setUpViewerAsEmbeddedInWindow(0, 0, a.width, a.height);
    viewer.setSceneData(&lit);
    setCamera(a, lit, viewer);
    osg::Camera& camera = *viewer.getCamera();
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(a.width, a.height, 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    camera.attach(osg::Camera::COLOR_BUFFER, image.get());
    window->getState()->setCheckForGLErrors(osg::State::ONCE_PER_FRAME);
    lit.setTimed(!a.statistics.empty());
    viewer.realize();
    for (int i = 0; i < a.frames; ++i) {
        const auto start = std::chrono::steady_clock::now();
        viewer.frame(i / 30.0);  // the scene's own time, not the clock's
        glFinish();
        const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        (i == 0 ? statistics.firstFrame : statistics.lastFrame) = ms;
    }
    lit.releaseGLObjects(window->getState());
    return image;
}

osg::ref_ptr<osg::Image> to8Bit(const osg::Image& image)
{
    osg::ref_ptr<osg::Image> out = new osg::Image;
    out->allocateImage(image.s(), image.t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int t = 0; t < image.t(); ++t)
        for (int s = 0; s < image.s(); ++s) {
            const float* in = reinterpret_cast<const float*>(image.data(unsigned(s), unsigned(t)));
            unsigned char* p = out->data(unsigned(s), unsigned(t));
            for (int k = 0; k < 3; ++k)
                p[k] = static_cast<unsigned char>(std::lround(255.0f * std::min(std::max(in[k], 0.0f), 1.0f)));
        }
    return out;
}

void writeImage(osg::Image& image, const std::string& name)
{
    const bool linear = osgDB::getLowerCaseFileExtension(name) == "exr";
    writeImageFile(linear ? image : *to8Bit(image), name);
}

void addOptions(CLI::App& app, Arguments& a)
{
    app.add_option("SCENE", a.scene, "a model, or a scene description (.envlight)")->required();
    app.add_option("--env", a.map, "environment map: a file, sky or studio");
    app.add_option("--env-layout", a.layout,
                   "layout of the map where its shape does not say it: " + osgEnvLight::mapLayoutChoices());
    app.add_option("--env-rotation", a.rotation, "degrees, counter-clockwise about +Z");
    app.add_option("--camera", a.cameraFile, "camera from a JSON file");
    app.add_option("--eye", a.eye, "x,y,z")->delimiter(',')->expected(3);
    app.add_option("--target", a.target, "x,y,z")->delimiter(',')->expected(3);
    app.add_option("--up", a.up, "x,y,z")->delimiter(',')->expected(3);
    app.add_option("--fovy", a.fovy, "vertical opening angle, degrees")->check(CLI::Range(0.01, 179.0));
    app.add_option("--size", a.size, "WIDTHxHEIGHT, default 512x512");
    app.add_option("--set", a.settings, "name=value of a property of Settings (switches take on | off); repeatable")
        ->allow_extra_args(false);
    app.add_option("--term", a.term,
                   "an intermediate instead of the picture: diffuse, specular, occlusion, albedo, normal, depth ...");
    app.add_option("--frames", a.frames, "frames to draw, the last is written; default 2")->check(CLI::Range(1, 1000000));
    app.add_option("--stats", a.statistics, "JSON file for plan and times");
    app.add_option("-o,--output", a.output, "OUT.exr (linear radiance) or OUT.png (exposed and tone mapped)")->required();
}

int run(Arguments& a)
{
    parseSize(a);
    addPluginPath();
    const std::string extension = osgDB::getLowerCaseFileExtension(a.output);
    if (extension != "exr" && extension != "png")
        throw BadArguments("-o is '" + a.output + "', expected a name ending in .exr or .png");
    osg::ref_ptr<osgEnvLight::LitScene> lit = loadScene(a.scene);
    applyOptions(a, *lit);
    const HeadlessContext context;
    Statistics statistics{a.scene, a.width, a.height, a.frames};
    writeImage(*render(a, *lit, statistics), a.output);
    std::string error;
    if (!a.statistics.empty() && !statistics.write(a.statistics, *lit, context, error)) throw std::runtime_error(error);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    CLI::App app("Renders a scene lit by a high-dynamic-range environment to an image, without an X server.", "envlight-render");
    addOptions(app, arguments);
    return runCommandLine(app, argc, argv, [&] { return run(arguments); });
}
