// SPDX-License-Identifier: MIT
// envlight-reference: the truth of a scene under its environment and its lights, ray traced.
#include "ImageFile.h"
#include "Interruption.h"
#include "Numbers.h"
#include "PluginPath.h"
#include "ProgressBar.h"
#include "ReferenceScene.h"
#include "SceneOptions.h"

#include <osgEnvLight/LightFile>

#include <reference/LayeredExr>
#include <reference/Reference>

#include <osgDB/FileNameUtils>

#include <algorithm>
#include <iostream>
#include <locale>
#include <sstream>

namespace
{

using osgEnvLight::Layer;
using osgEnvLight::Picture;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::ReferenceResult;

struct Arguments {
    SceneOptions scene;
    std::string output;
    std::string paths = "direct";
    std::string estimator = "mis";
    std::string term = "beauty";
    std::string lights;
    std::vector<int> pixel;
    ReferenceOptions options;
    bool quiet = false;
};

const std::vector<std::string> pathNames = {"unoccluded", "direct", "full"};
const std::vector<std::string> estimatorNames = {"cosine", "uniform", "mis"};
const std::vector<std::string> termNames = {"beauty",   "diffuse",  "specular", "occlusion", "visibility", "sun",
                                            "indirect", "emission", "albedo",   "normal",    "depth"};

int indexOf(const std::string& name, const std::vector<std::string>& names)
{
    return int(std::find(names.begin(), names.end(), name) - names.begin());
}

std::set<Layer> layersOf(const Arguments& a)
{
    if (a.term == "diffuse") return {Layer::DIFFUSE, Layer::OCCLUSION};
    if (a.term == "specular") return {Layer::SPECULAR_VISIBLE};
    if (a.term == "occlusion") return {Layer::OCCLUSION};
    if (a.term == "visibility") return {Layer::DIFFUSE, Layer::OCCLUSION};
    if (a.term == "indirect") return {Layer::INDIRECT};
    if (a.term == "emission") return {Layer::EMISSION};
    if (a.term == "albedo") return {Layer::ALBEDO};
    if (a.term == "normal") return {Layer::NORMAL};
    if (a.term == "depth") return {Layer::DEPTH};
    return {};
}

Picture combine(Picture a, const Picture& b, float factor)
{
    for (size_t i = 0; i < a.rgba.size(); ++i)
        if (i % 4 != 3) a.rgba[i] += factor * b.rgba[i];
    return a;
}

// The term as envlight-render encodes it, and its standard error.
std::pair<Picture, Picture> termOf(const Arguments& a, const ReferenceResult& result, const ReferenceScene& scene)
{
    if (a.term == "diffuse") {
        const Picture error = result.standardError(Layer::DIFFUSE);
        return {combine(result.mean(Layer::DIFFUSE), result.mean(Layer::OCCLUSION), -1.0f), error};
    }
    if (a.term == "visibility") return {result.visibility(), Picture(a.scene.width, a.scene.height)};
    const std::set<Layer> layers = layersOf(a);
    const Layer layer = layers.empty() ? Layer::BEAUTY : *layers.begin();
    Picture picture = result.mean(layer);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            float* p = picture.at(x, y);
            if (a.term == "normal" && p[3] > 0.0f) scene.encodeNormal(p);
            if (a.term == "depth")
                for (int k = 0; k < 3; ++k) p[k] /= float(4.0 * scene.radius());
        }
    return {picture, result.standardError(layer)};
}

bool isPng(const Arguments& a)
{
    return osgDB::getLowerCaseFileExtension(a.output) == "png";
}

bool isMetered(const Arguments& a, const ReferenceScene& scene)
{
    return isPng(a) && a.term == "beauty" && scene.adapts();
}

void write(const Arguments& a, const ReferenceResult& result, const ReferenceScene& scene)
{
    const auto [picture, error] = termOf(a, result, scene);
    if (isPng(a)) {
        const bool metered = isMetered(a, scene);
        const Picture albedo = metered ? result.mean(Layer::ALBEDO) : Picture();
        return writeImageFile(*scene.displayed(picture, metered ? &albedo : nullptr), a.output);
    }
    Picture variance = error;
    for (float& v : variance.rgba) v *= v;
    std::ostringstream relative;
    relative.imbue(std::locale::classic());
    relative << result.relativeError(Layer::BEAUTY);
    osgEnvLight::writeLayeredExr(a.output, picture, {{"variance", &variance}},
                                 {{"software", "envlight-reference"},
                                  {"scene", a.scene.scene},
                                  {"paths", a.paths},
                                  {"estimator", a.estimator},
                                  {"term", a.term},
                                  {"samplesPerPixel", std::to_string(result.samples)},
                                  {"seed", std::to_string(a.options.seed)},
                                  {"relativeStandardError", relative.str()},
                                  {"state", result.interrupted ? "interrupted" : "complete"}});
}

int run(Arguments& a)
{
    a.scene.check();
    const std::string extension = osgDB::getLowerCaseFileExtension(a.output);
    if (extension != "exr" && extension != "png")
        throw BadArguments("-o is '" + a.output + "', expected a name ending in .exr or .png");
    a.options.paths = ReferenceOptions::Paths(indexOf(a.paths, pathNames));
    a.options.estimator = ReferenceOptions::Estimator(indexOf(a.estimator, estimatorNames));
    if (a.options.error > 0.0 && a.options.samples == 0) a.options.samples = 1u << 24;
    if (a.options.samples == 0) a.options.samples = 256;
    if (!a.pixel.empty() && (a.pixel[0] >= a.scene.width || a.pixel[1] >= a.scene.height || a.pixel[0] < 0 || a.pixel[1] < 0))
        throw BadArguments("--pixel is outside the picture of " + a.scene.size);
    addPluginPath();
    const osg::ref_ptr<osgEnvLight::LitScene> lit = a.scene.load(extension == "exr");
    ReferenceScene scene(*lit, a.scene);
    if (a.term == "sun") scene.keepSuns();
    osgEnvLight::LightFile lights;
    std::string error;
    if (!a.lights.empty()) {
        if (!osgEnvLight::readLightFile(a.lights, lights, error)) throw std::runtime_error(error);
        scene.setLights(lights);
    }
    for (const std::string& what : scene.triangles().leftOut) std::cerr << "envlight-reference: left out: " << what << "\n";
    if (scene.triangles().triangles == 0) std::cerr << "envlight-reference: the scene has no surface\n";
    if (!a.pixel.empty()) {
        // Rows are counted from the top, as picture viewers count them.
        const Picture p = scene.reference().integrand(a.pixel[0], a.scene.height - 1 - a.pixel[1], 1024,
                                                      a.options.paths != ReferenceOptions::UNOCCLUDED);
        if (extension == "png")
            writeImageFile(*scene.displayed(p), a.output);
        else
            osgEnvLight::writeLayeredExr(a.output, p, {}, {});
        return 0;
    }
    const Interruption interruption;
    ProgressBar bar(a.quiet);
    std::set<Layer> layers = layersOf(a);
    if (isMetered(a, scene)) layers.insert(Layer::ALBEDO);
    const ReferenceResult result = scene.reference().render(a.options, layers, [&](const auto& progress) {
        bar.show(progress.fraction, std::to_string(progress.samples) + " spp, error " + percent(progress.error));
        return !Interruption::requested();
    });
    bar.finish();
    write(a, result, scene);
    if (!a.quiet)
        std::cerr << result.samples << " samples per pixel, standard error " << percent(result.relativeError(Layer::BEAUTY))
                  << " of the mean, " << double(result.rays) / 1e6 / std::max(result.seconds, 1e-9) << " M rays/s\n";
    if (result.interrupted) throw std::runtime_error("interrupted; " + a.output + " holds what there was");
    if (a.options.error > 0.0 && result.relativeError(Layer::BEAUTY) > a.options.error)
        throw std::runtime_error("--error was not reached within --spp; " + a.output + " holds what there is");
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments a;
    a.options.samples = 0;
    CommandLine line(
        "envlight-reference",
        "The picture that an exact renderer would make of the scene: ray traced, unbiased, with its own uncertainty.");
    a.scene.addTo(line);
    line.add("--paths", a.paths,
             "unoccluded: environment and lights unhindered; direct (default): stopped by the scene; full: from surface to "
             "surface")
        .oneOf(pathNames);
    line.add("--term", a.term,
             "a part of the picture, by --paths: beauty, diffuse, specular, occlusion, visibility, sun (the map's suns "
             "alone), indirect, emission, albedo, normal, depth")
        .oneOf(termNames);
    line.add("--estimator", a.estimator,
             "mis (default): map, area lights, lobe and cosine together; cosine or uniform: nothing is shared with the shaders "
             "but the "
             "BRDF's value, the same mean with far more noise")
        .oneOf(estimatorNames);
    line.add("--spp", a.options.samples, "samples per pixel, default 256").within(1u, 1u << 24);
    line.add("--error", a.options.error, "stop at this standard error, as a share of the picture's mean: .01 is 1 %")
        .within(1e-6, 1.0);
    line.add("--seed", a.options.seed, "of the random numbers, default 0");
    line.addFlag("--antialias", a.options.antialias, "points spread over the pixel; without, its centre, as the rasteriser's");
    line.add("--lights", a.lights, "light D by this list (envlight-lights) instead of by the map");
    line.add("--pixel", a.pixel, "x,y from the upper left: write this pixel's integrand over all directions instead")
        .separatedBy(',')
        .ofValues(2);
    line.addFlag("--quiet", a.quiet, "no progress, no summary");
    line.add("-o,--output", a.output, "OUT.exr (linear, with a layer of its variance) or OUT.png").required();
    return line.run(argc, argv, [&] { return run(a); });
}
