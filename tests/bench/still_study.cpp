// SPDX-License-Identifier: MIT
// How fast the average of a still view comes to the truth, after so many frames: the root mean square error over the mean, and
// under it as a tone curve shows it (the image suite's tRMSE). The truth is direct light, or with --full all light.
// With --glossy only pixels that have a lobe count.
//   envlight_still_study [--full] [--glossy] [SCENE:MAP]... [NAME=VALUE]...
// Scenes and maps are those of the image suite, settings those of the nodekit; accumulateFrames ends it.
#include <metrics/Mask>
#include <metrics/Metrics>
#include <reference/Reference>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "MetalBalls.h"
#include "SceneRenderer.h"
#include "SuiteScenes.h"
#include "TracedView.h"

using osgEnvLight::Layer;
using osgEnvLight::Mask;

namespace
{

const int width = 96, height = 72;
const unsigned samples = 1024;
using Paths = osgEnvLight::ReferenceOptions::Paths;
const std::vector<int> milestones = {1, 4, 16, 32, 48, 64, 128, 256};

struct Truth {
    Picture mean, error;
    Mask inside;

    osgEnvLight::ErrorFigures errorOf(const Picture& picture) const { return osgEnvLight::compare(picture, mean, error, inside); }
};

struct Options {
    Paths paths = osgEnvLight::ReferenceOptions::DIRECT;
    bool glossy = false;
    std::vector<std::string> settings;
};

Truth truthOf(osgEnvLight::LitScene& lit, SceneRenderer& renderer, const Picture& picture, const Options& options)
{
    std::set<Layer> layers = {Layer::BEAUTY, Layer::NORMAL, Layer::DEPTH};
    if (options.glossy) layers.insert(Layer::SPECULAR);
    const osgEnvLight::ReferenceResult result = tracedView(lit, renderer, samples, layers, true, options.paths);
    Truth truth{result.mean(Layer::BEAUTY), result.standardError(Layer::BEAUTY), Mask()};
    truth.inside = awayFromEdges(Mask::geometry(truth.mean) & Mask::geometry(picture), result);
    if (options.glossy) truth.inside = truth.inside & glossyPixels(result);
    return truth;
}

void measure(const std::string& sceneName, const std::string& map, const Options& options)
{
    suite::SuiteScene scene = suite::makeScene(sceneName);
    if (!scene.lit || !suite::setMap(*scene.lit, map)) throw std::runtime_error(sceneName + " or " + map + " is not installed");
    if (options.paths == osgEnvLight::ReferenceOptions::DIRECT) {
        scene.lit->getSettings()->bounce = osgEnvLight::Settings::BOUNCE_OFF;
        scene.lit->getSettings()->reflections = osgEnvLight::Settings::REFLECTIONS_MAP;
    }
    scene.lit->getSettings()->accumulate = true;
    for (const std::string& s : options.settings) {
        std::string error;
        if (!scene.lit->getSettings()->set(s.substr(0, s.find('=')), s.substr(s.find('=') + 1), error))
            throw std::runtime_error(error);
    }
    SceneRenderer renderer(width, height);
    renderer.lookAt(scene.eye, scene.target, osg::Vec3d(0, 0, 1), scene.fovy);
    Picture picture = renderer.render(scene.lit.get());
    const Truth truth = truthOf(*scene.lit, renderer, picture, options);
    std::printf("%-18s", (sceneName + " " + map).c_str());
    std::vector<double> toned, milliseconds = {0.0};
    int drawn = 1;
    for (int frames : milestones) {
        if (frames > scene.lit->getSettings()->accumulateFrames) break;
        const auto start = std::chrono::steady_clock::now();
        if (frames > drawn) picture = renderer.render(scene.lit.get(), frames - drawn);
        if (frames > drawn)
            milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() /
                                   (frames - drawn));
        drawn = frames;
        const osgEnvLight::ErrorFigures e = truth.errorOf(picture);
        std::printf(" %7.3f", 100.0 * e.rmse / e.mean);
        std::fflush(stdout);
        toned.push_back(100.0 * e.tRmse);
    }
    std::printf("\n%-18s", "  toned");
    for (double e : toned) std::printf(" %7.3f", e);
    std::printf("\n%-18s", "  ms a frame");
    for (double m : milliseconds) std::printf(" %7.0f", m);
    std::printf("\n");
}

}  // namespace

int main(int argc, char** argv)
try {
    std::vector<std::string> rows;
    Options options;
    for (const std::string& argument : std::vector<std::string>(argv + 1, argv + argc)) {
        if (argument == "--full")
            options.paths = osgEnvLight::ReferenceOptions::FULL;
        else if (argument == "--glossy")
            options.glossy = true;
        else
            (argument.find('=') == std::string::npos ? rows : options.settings).push_back(argument);
    }
    if (rows.empty())
        for (const char* scene : {"slot", "room", "post", "stairs", "chess"})
            for (const char* map : {"sky", "courtyard", "interior"}) rows.push_back(std::string(scene) + ":" + map);
    std::printf("%-18s", "error in % after");
    for (int frames : milestones) std::printf(" %7d", frames);
    std::printf("\n");
    for (const std::string& row : rows) measure(row.substr(0, row.find(':')), row.substr(row.find(':') + 1), options);
} catch (const std::exception& e) {
    std::cerr << "envlight_still_study: " << e.what() << '\n';
    return 1;
}
