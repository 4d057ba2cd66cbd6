// SPDX-License-Identifier: MIT
// How far S is from the truth, by roughness: metal balls beside each other on a floor, tRMSE in % of the term where nothing is in
// the way ("open"), of what the scene leaves of it ("seen"), and that of means over 8 x 8 pixels ("blocks"), where noise averages
// out and blotches stay; then the share of the light that the scene takes ("without"). Beside full light transport, of the whole
// picture: with black where the scene is in the way ("black"), and with what the view shows of it ("shown").
//   envlight_specular_study [MAP...] [NAME=VALUE...] [--roughness R]... [--direct] [--pictures FOLDER]
//     MAP          of the image suite
//     NAME=VALUE   a setting of the nodekit; "shown" has probes and rays through the picture if none says otherwise
//     --roughness  instead of eight of them
//     --direct     no light transport
#include <metrics/Display>
#include <metrics/Mask>
#include <metrics/Metrics>
#include <reference/Reference>

#include <ImageFile.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "MetalBalls.h"
#include "SceneRenderer.h"
#include "SuiteScenes.h"

using osgEnvLight::ErrorFigures;
using osgEnvLight::Layer;
using osgEnvLight::LitScene;
using osgEnvLight::Mask;
using osgEnvLight::Settings;

namespace
{

const int width = 192, height = 128;
const unsigned samples = 256;

osg::ref_ptr<LitScene> makeBalls(float roughness)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->output = Settings::LINEAR;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    addMetalBalls(*lit, osg::Vec3f(0.9f, 0.85f, 0.75f), roughness);
    lit->addChild(makeBox(osg::Vec3d(-2.6, 2.2, 0), osg::Vec3d(2.6, 2.5, 2.4)));
    return lit;
}

// Means over blocks of 8 x 8 of the pixels that count.
Picture blocksOf(const Picture& picture, const Mask& mask)
{
    Picture result(picture.width / 8, picture.height / 8);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            double sum[4] = {};
            for (int k = 0; k < 64; ++k) {
                const int px = 8 * x + k % 8, py = 8 * y + k / 8;
                if (!mask.at(px, py)) continue;
                for (int channel = 0; channel < 3; ++channel) sum[channel] += picture.color(px, py)[channel];
                sum[3] += 1.0;
            }
            float* out = &result.rgba[4 * (size_t(y) * size_t(result.width) + size_t(x))];
            for (int channel = 0; channel < 3; ++channel) out[channel] = sum[3] > 0.0 ? float(sum[channel] / sum[3]) : 0.0f;
            out[3] = sum[3] >= 16.0 ? 1.0f : 0.0f;
        }
    return result;
}

double blockError(const Picture& picture, const Picture& truth, const Mask& mask)
{
    const Picture a = blocksOf(picture, mask), b = blocksOf(truth, mask);
    return osgEnvLight::compare(a, b, Mask::geometry(b)).tRmse;
}

void write(const Picture& picture, double stops, const std::string& name)
{
    writeImageFile(*osgEnvLight::eightBit(osgEnvLight::displayEncoded(picture, stops)), name);
}

std::string pictureName(const std::string& folder, const std::string& map, float roughness, const char* what)
{
    char name[64];
    std::snprintf(name, sizeof(name), "/%s-%.2f-%s.png", map.c_str(), double(roughness), what);
    return folder + name;
}

struct Row {
    double open = 0.0, seen = 0.0, blocks = 0.0, without = 0.0;
    double black = 0.0, shown = 0.0;
};

// The picture with one of the settings' reflections, direct light where nothing is reflected from surface to surface.
Picture beauty(LitScene& lit, SceneRenderer& renderer, int bounce, int reflections)
{
    Settings& settings = *lit.getSettings();
    settings.view = Settings::BEAUTY;
    settings.visibility = osg::ref_ptr<Settings>(new Settings)->visibility;
    settings.bounce = bounce;
    settings.reflections = reflections;
    return renderer.render(&lit);
}

struct Options {
    std::vector<std::string> maps, settings;
    std::vector<float> roughnesses;
    std::string pictures;
    bool direct = false;
};

void apply(const std::vector<std::string>& assignments, Settings& settings)
{
    for (const std::string& a : assignments) {
        std::string error;
        if (!settings.set(a.substr(0, a.find('=')), a.substr(a.find('=') + 1), error)) throw std::runtime_error(error);
    }
}

Row measure(const std::string& map, float roughness, const Options& options)
{
    const std::string& pictures = options.pictures;
    osg::ref_ptr<LitScene> lit = makeBalls(roughness);
    if (!suite::setMap(*lit, map)) throw std::runtime_error(map + " is not installed");
    const osg::ref_ptr<Settings> shown = new Settings;
    shown->bounce = Settings::BOUNCE_PROBES;
    for (Settings* settings : {lit->getSettings(), shown.get()}) apply(options.settings, *settings);
    SceneRenderer renderer(width, height);
    lookAtMetalBalls(renderer);
    lit->getSettings()->view = Settings::SPECULAR;
    const Picture seen = renderer.render(lit);
    lit->getSettings()->visibility = Settings::VISIBILITY_NONE;
    const Picture open = renderer.render(lit);
    const osgEnvLight::ReferenceResult truth = tracedSpecular(*lit, renderer, samples);
    const Mask mask = glossyPixels(truth);
    const auto error = [&](const Picture& picture, Layer layer) {
        return osgEnvLight::compare(picture, truth.mean(layer), truth.standardError(layer), mask).tRmse;
    };
    Row row;
    row.open = error(open, Layer::SPECULAR);
    row.seen = error(seen, Layer::SPECULAR_VISIBLE);
    row.blocks = blockError(seen, truth.mean(Layer::SPECULAR_VISIBLE), mask);
    row.without = error(truth.mean(Layer::SPECULAR), Layer::SPECULAR_VISIBLE);
    if (!pictures.empty()) {
        const Picture& right = truth.mean(Layer::SPECULAR_VISIBLE);
        const double stops = osgEnvLight::automaticExposure(right, mask);
        write(seen, stops, pictureName(pictures, map, roughness, "ours"));
        write(right, stops, pictureName(pictures, map, roughness, "truth"));
        write(open, stops, pictureName(pictures, map, roughness, "open"));
        write(truth.mean(Layer::SPECULAR), stops, pictureName(pictures, map, roughness, "opentruth"));
    }
    if (options.direct) return row;
    const osgEnvLight::ReferenceResult full =
        tracedView(*lit, renderer, samples, {Layer::BEAUTY}, false, osgEnvLight::ReferenceOptions::FULL);
    const Picture& all = full.mean(Layer::BEAUTY);
    const double stops = osgEnvLight::automaticExposure(all, mask);
    if (!pictures.empty()) write(all, stops, pictureName(pictures, map, roughness, "full"));
    const auto fullError = [&](int bounce, int reflections) {
        const Picture picture = beauty(*lit, renderer, bounce, reflections);
        if (!pictures.empty() && bounce != Settings::BOUNCE_OFF)
            write(picture, stops, pictureName(pictures, map, roughness, "shown"));
        return osgEnvLight::compare(picture, all, full.standardError(Layer::BEAUTY), mask).tRmse;
    };
    row.black = fullError(Settings::BOUNCE_OFF, Settings::REFLECTIONS_MAP);
    row.shown = fullError(shown->bounce, shown->reflections);
    return row;
}

Options parse(const std::vector<std::string>& words)
{
    Options o;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--pictures" && i + 1 < words.size())
            o.pictures = words[++i];
        else if (word == "--roughness" && i + 1 < words.size())
            o.roughnesses.push_back(std::stof(words[++i]));
        else if (word == "--direct")
            o.direct = true;
        else
            (word.find('=') == std::string::npos ? o.maps : o.settings).push_back(word);
    }
    if (o.maps.empty()) o.maps = {"courtyard", "city", "studio", "sunset"};
    if (o.roughnesses.empty()) o.roughnesses = {0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.8f};
    return o;
}

void print(const std::string& map, const std::vector<Row>& rows, bool direct)
{
    const std::pair<const char*, double Row::*> lines[] = {{"open", &Row::open},     {"seen", &Row::seen},
                                                           {"blocks", &Row::blocks}, {"without", &Row::without},
                                                           {"black", &Row::black},   {"shown", &Row::shown}};
    for (const auto& [name, member] : lines) {
        if (direct && member == &Row::black) return;
        std::printf("%-10s %-10s", map.c_str(), name);
        double sum = 0.0;
        for (const Row& row : rows) {
            std::printf(" %6.2f", 100.0 * row.*member);
            sum += row.*member;
        }
        std::printf(" %6.2f\n", 100.0 * sum / double(rows.size()));
    }
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
try {
    const Options options = parse({argv + 1, argv + argc});
    std::printf("%-10s %-10s", "tRMSE, %", "roughness");
    for (float r : options.roughnesses) std::printf(" %6.2f", double(r));
    std::printf("   mean\n");
    for (const std::string& map : options.maps) {
        std::vector<Row> rows;
        for (float r : options.roughnesses) rows.push_back(measure(map, r, options));
        print(map, rows, options.direct);
    }
} catch (const std::exception& e) {
    std::cerr << "envlight_specular_study: " << e.what() << '\n';
    return 1;
}
