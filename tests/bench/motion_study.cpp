// SPDX-License-Identifier: MIT
// What a moving picture shows, beside means of 4 x 4 samples a pixel of the same moments, in display values.
//   envlight_motion_study [SCENE:MAP]... [NAME=VALUE]...
// Each first as the view pans, then, without shadows, as the scene turns about the eye and the view stands still.
// Columns:
//   error    root mean square, at .25 pixels a frame
//   flicker  how much of that changes from frame to frame: its standard deviation over four frames
//   fast     the error at 2.3 pixels a frame
//   ms       milliseconds a frame
// Scenes and maps are those of the image suite, settings those of the nodekit.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <vector>

#include <osg/MatrixTransform>
#include "MovingPictures.h"
#include "SceneRenderer.h"
#include "SuiteScenes.h"

namespace
{

const int width = 256, height = 192;
const double slowly = 0.25, fast = 2.3;  // pixels a frame
const int finer = 4;                     // samples along each side of a pixel of the truth
const int before = 16, judged = 4;       // frames of a pan

struct Row {
    std::string scene, map;
    std::vector<std::string> settings;
    bool turnsScene = false;
};

struct View {
    suite::SuiteScene scene;
    osg::ref_ptr<osg::MatrixTransform> turned;  // null: the view pans
    osg::Matrixd turn(double pixels) const
    {
        const double pixel = 2.0 * std::tan(osg::DegreesToRadians(scene.fovy) / 2.0) / height;
        return osg::Matrixd::rotate(pixels * pixel, 0, 0, 1);
    }
    void aim(SceneRenderer& renderer, double pixels) const
    {
        if (turned) {
            turned->setMatrix(osg::Matrixd::translate(-scene.eye) * turn(-pixels) * osg::Matrixd::translate(scene.eye));
            pixels = 0.0;
        }
        renderer.lookAt(scene.eye, scene.eye + (scene.target - scene.eye) * turn(pixels), osg::Vec3d(0, 0, 1), scene.fovy);
    }
};

View viewOf(const Row& row)
{
    View view{suite::makeScene(row.scene), nullptr};
    osgEnvLight::LitScene* lit = view.scene.lit.get();
    if (!lit || !suite::setMap(*lit, row.map)) throw std::runtime_error(row.scene + " or " + row.map + " is not installed");
    osgEnvLight::Settings& s = *lit->getSettings();
    if (row.turnsScene) {
        view.turned = new osg::MatrixTransform;
        for (unsigned i = 0; i < lit->getNumChildren(); ++i) view.turned->addChild(lit->getChild(i));
        lit->removeChildren(0, lit->getNumChildren());
        lit->addChild(view.turned);
        s.occlusion = false;  // maps of all that casts shadows, drawn in each frame, take minutes
        s.bounce = osgEnvLight::Settings::BOUNCE_OFF;
    }
    s.output = osgEnvLight::Settings::DISPLAY;
    s.dither = false;
    s.accumulate = false;
    for (const std::string& given : row.settings) {
        std::string error;
        if (!s.set(given.substr(0, given.find('=')), given.substr(given.find('=') + 1), error)) throw std::runtime_error(error);
    }
    return view;
}

void settle(SceneRenderer& renderer, const View& view)
{
    view.aim(renderer, 0.0);
    renderer.render(view.scene.lit.get(), 2);
    for (int i = 0; i < 100 && view.scene.lit->regenerating(); ++i) renderer.render(view.scene.lit.get(), 4);
}

std::vector<Picture> truthOf(Row row, double speed)
{
    row.settings.emplace_back("antialias=off");
    const View view = viewOf(row);
    SceneRenderer renderer(width * finer, height * finer);
    settle(renderer, view);
    std::vector<Picture> all;
    for (int i = 0; i < judged; ++i) {
        view.aim(renderer, speed * (before + i));
        all.push_back(shrunk(renderer.render(view.scene.lit.get(), 1), finer));
    }
    return all;
}

struct Measured {
    MovingErrors errors;
    double milliseconds;
};

Measured measuredOf(const Row& row, double speed, const std::vector<Picture>& truth)
{
    const View view = viewOf(row);
    SceneRenderer renderer(width, height);
    settle(renderer, view);
    std::vector<Picture> all;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < before + judged; ++i) {
        view.aim(renderer, speed * i);
        const Picture picture = renderer.render(view.scene.lit.get(), 1);
        if (i >= before) all.push_back(picture);
    }
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    return {errorsOf(all, truth), time.count() / (before + judged)};
}

void measure(const Row& row)
{
    const std::vector<Picture> slowTruth = truthOf(row, slowly), fastTruth = truthOf(row, fast);
    std::printf("%s %s%s\n", row.scene.c_str(), row.map.c_str(), row.turnsScene ? ", the scene turns" : "");
    for (const char* kind : {"off", "edges", "temporal"}) {
        Row r = row;
        r.settings.push_back(std::string("antialias=") + kind);
        const Measured slow = measuredOf(r, slowly, slowTruth);
        const double fastError = measuredOf(r, fast, fastTruth).errors.error;
        std::printf("  %-10s %7.3f %7.3f %7.3f %7.0f\n", kind, 100.0 * slow.errors.error, 100.0 * slow.errors.change,
                    100.0 * fastError, slow.milliseconds);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv)
try {
    std::vector<std::string> rows, settings;
    for (const std::string& argument : std::vector<std::string>(argv + 1, argv + argc))
        (argument.find('=') == std::string::npos ? rows : settings).push_back(argument);
    if (rows.empty()) rows = {"chess:sky", "atrium:sky", "spheres:studio", "spheres:courtyard"};
    std::printf("%-12s %7s %7s %7s %7s\n", "in % of white", "error", "flicker", "fast", "ms");
    for (const std::string& row : rows)
        for (const bool turnsScene : {false, true})
            measure({row.substr(0, row.find(':')), row.substr(row.find(':') + 1), settings, turnsScene});
} catch (const std::exception& e) {
    std::cerr << "envlight_motion_study: " << e.what() << '\n';
    return 1;
}
