// SPDX-License-Identifier: MIT
// How far shadows of area lights are from the truth, in eight scenes: tRMSE in % beside direct light traced by that many samples,
// without shadows and by the number of points on the lights; the table of area-lights.md 2 B.
//   envlight_area_study [SCENE...] [NAME=VALUE...] [--points N]... [--samples N] [--pictures FOLDER] [--open]
//     NAME=VALUE  a setting of the nodekit
//     --open      beside light without shadows: the closed forms alone
//     --full      beside full light transport, with no light between surfaces, the mean and probes
#include <metrics/Display>

#include <osgEnvLight/Material>

#include <ImageFile.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "AreaScenes.h"

using osgEnvLight::LitScene;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

namespace
{

const int size = 256;

struct Options {
    std::vector<std::string> scenes, settings;
    std::vector<int> points;
    unsigned samples = 1024;
    ReferenceOptions::Paths paths = ReferenceOptions::DIRECT;
    std::string pictures;
};

Options parse(const std::vector<std::string>& words)
{
    Options o;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--pictures" && i + 1 < words.size())
            o.pictures = words[++i];
        else if (word == "--points" && i + 1 < words.size())
            o.points.push_back(std::stoi(words[++i]));
        else if (word == "--samples" && i + 1 < words.size())
            o.samples = unsigned(std::stoi(words[++i]));
        else if (word == "--open")
            o.paths = ReferenceOptions::UNOCCLUDED;
        else if (word == "--full")
            o.paths = ReferenceOptions::FULL;
        else
            (word.find('=') == std::string::npos ? o.scenes : o.settings).push_back(word);
    }
    if (o.scenes.empty()) o.scenes.assign(std::begin(suite::areaScenes), std::end(suite::areaScenes));
    if (o.points.empty() && o.paths == ReferenceOptions::DIRECT) o.points = {16, 32, 64, 128, 256};
    return o;
}

void write(const Picture& picture, double stops, const std::string& name)
{
    writeImageFile(*osgEnvLight::eightBit(osgEnvLight::displayEncoded(picture, stops)), name);
}

// Without shadows, then by the points, or by the light between surfaces.
std::vector<double> measure(const std::string& scene, const Options& options)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = suite::makeAreaScene(scene, renderer);
    for (const std::string& s : options.settings) {
        std::string error;
        if (!lit->getSettings()->set(s.substr(0, s.find('=')), s.substr(s.find('=') + 1), error)) throw std::runtime_error(error);
    }
    // White walls would keep all light for ever.
    if (options.paths == ReferenceOptions::FULL)
        osgEnvLight::Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.7f, 0.7f));
    const suite::AreaTruth truth = suite::tracedArea(*lit, renderer, options.samples, options.paths);
    const double stops = osgEnvLight::automaticExposure(truth.picture, truth.mask);
    if (!options.pictures.empty()) write(truth.picture, stops, options.pictures + "/" + scene + "-truth.png");
    std::vector<double> errors;
    const auto add = [&](const std::string& name) {
        const Picture picture = renderer.render(lit, suite::areaFrames);
        errors.push_back(osgEnvLight::compare(picture, truth.picture, truth.error, truth.mask).tRmse);
        if (!options.pictures.empty()) write(picture, stops, options.pictures + "/" + scene + "-" + name + ".png");
    };
    lit->getSettings()->occlusion = false;
    add("open");
    lit->getSettings()->occlusion = true;
    if (options.paths == ReferenceOptions::UNOCCLUDED) return errors;
    if (options.paths == ReferenceOptions::FULL) {
        for (int bounce = Settings::BOUNCE_OFF; bounce <= Settings::BOUNCE_PROBES; ++bounce) {
            lit->getSettings()->bounce = bounce;
            add("bounce" + std::to_string(bounce));
        }
        return errors;
    }
    for (const int points : options.points) {
        lit->getSettings()->areaPoints = points;
        add(std::to_string(points));
    }
    return errors;
}

}  // namespace

int main(int argc, char** argv)
try {
    const Options options = parse({argv + 1, argv + argc});
    std::printf("%-10s %7s", "tRMSE, %", "open");
    for (int points : options.points) std::printf(" %7d", points);
    std::printf(options.paths == ReferenceOptions::FULL ? "     off    mean  probes\n" : "\n");
    for (const std::string& scene : options.scenes) {
        std::printf("%-10s", scene.c_str());
        for (double error : measure(scene, options)) std::printf(" %7.2f", 100.0 * error);
        std::printf("\n");
        std::fflush(stdout);
    }
} catch (const std::exception& e) {
    std::cerr << "envlight_area_study: " << e.what() << '\n';
    return 1;
}
