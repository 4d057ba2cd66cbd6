// SPDX-License-Identifier: MIT
#include "Suite.h"

#include "ReferenceCache.h"
#include "SuiteScenes.h"

#include <metrics/Display>
#include <metrics/Metrics>
#include <metrics/Ssim>
#include <reference/Reference>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>

namespace suite
{

using osgEnvLight::ErrorFigures;
using osgEnvLight::Layer;
using osgEnvLight::Mask;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

const char* const figureNames[NUM_FIGURES] = {"relMSE", "tRMSE", "1-SSIM", "D", "S", "O", "bounced", "silhouette"};

namespace
{

std::vector<std::pair<std::string, std::string>> settingsOfAllRows;

template <class Value>
void apply(Settings& settings, const std::string& name, const Value& value)
{
    std::string error;
    if (!settings.set(name, value, error)) throw std::runtime_error(error);
}

const char* const cacheFolder = ENVLIGHT_BINARY_DIR "/references";

// A layer and its standard error.
struct Estimate {
    Picture mean;
    Picture error;
};

struct Truth {
    Estimate full;  // with light from surface to surface
    Estimate beauty, diffuse, specular, occlusion;
    Picture normal;
    Picture depth;
    Picture blended;
};

ReferenceOptions referenceOptions(ReferenceOptions::Paths paths)
{
    ReferenceOptions o;
    o.paths = paths;
    o.estimator = ReferenceOptions::MIS;
    o.samples = 64;
    o.pass = 32;
    return o;
}

const Layer sampledLayers[] = {Layer::BEAUTY, Layer::DIFFUSE, Layer::SPECULAR, Layer::OCCLUSION};
const Layer exactLayers[] = {Layer::NORMAL, Layer::DEPTH, Layer::BLENDED};

ReferenceCache::Pictures trace(const osgEnvLight::TriangleScene& triangles, const osgEnvLight::RayCamera& camera,
                               const osgEnvLight::Environment& environment)
{
    const osgEnvLight::RayScene rays(triangles);
    const osgEnvLight::Reference reference(rays, camera, environment);
    std::set<Layer> layers(std::begin(sampledLayers), std::end(sampledLayers));
    layers.insert(std::begin(exactLayers), std::end(exactLayers));
    const osgEnvLight::ReferenceResult result = reference.render(referenceOptions(ReferenceOptions::DIRECT), layers);
    const osgEnvLight::ReferenceResult full = reference.render(referenceOptions(ReferenceOptions::FULL), {Layer::BEAUTY});
    ReferenceCache::Pictures pictures = {full.mean(Layer::BEAUTY), full.standardError(Layer::BEAUTY)};
    for (Layer layer : sampledLayers) {
        pictures.push_back(result.mean(layer));
        pictures.push_back(result.standardError(layer));
    }
    for (Layer layer : exactLayers) pictures.push_back(result.mean(layer));
    return pictures;
}

osg::ref_ptr<const osgEnvLight::RadianceMap> radianceOf(const osgEnvLight::EnvironmentMap& map)
{
    std::string error;
    osg::ref_ptr<const osgEnvLight::RadianceMap> radiance = map.radiance(error);
    if (!radiance) throw std::runtime_error(error);
    return radiance;
}

// The scene as the viewer's camera saw it in its last frame.
Truth truthOf(osgEnvLight::LitScene& lit, osgViewer::Viewer& viewer)
{
    osg::Camera& camera = *viewer.getCamera();
    const osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    const osg::ref_ptr<const osgEnvLight::RadianceMap> radiance = radianceOf(map);
    const osgEnvLight::TriangleScene triangles = osgEnvLight::flattenScene(lit, camera, viewer.getFrameStamp());

    ContentHash hash;
    hash.file(ENVLIGHT_REFERENCE_LIBRARY);  // its code
    hash.scene(triangles);
    hash.camera(camera.getViewMatrix(), camera.getProjectionMatrix(), width, height);
    hash.map(*radiance, map.getRotation(), map.getIntensity());
    hash.options(referenceOptions(ReferenceOptions::DIRECT));
    hash.options(referenceOptions(ReferenceOptions::FULL));

    const ReferenceCache::Pictures p = ReferenceCache(cacheFolder).get(hash.get(), [&] {
        return trace(triangles, osgEnvLight::RayCamera(camera, lit.getBound()),
                     osgEnvLight::MapEnvironment(*radiance, map.getRotation(), map.getIntensity()));
    });
    return {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}, {p[8], p[9]}, p[10], p[11], p[12]};
}

void setCamera(const SuiteScene& scene, bool orthographic, SceneRenderer& renderer)
{
    renderer.lookAt(scene.eye, scene.target, osg::Vec3d(0, 0, 1), scene.fovy);
    if (!orthographic) return;
    const double y = (scene.target - scene.eye).length() * std::tan(osg::DegreesToRadians(0.5 * scene.fovy));
    const double x = y * width / height;
    renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-x, x, -y, y, 1.0, 10000.0);
}

double silhouette(const Picture& a, const Picture& b)
{
    size_t differing = 0;
    for (size_t i = 0; i < a.pixels(); ++i) differing += (a.rgba[4 * i + 3] > 0.5f) != (b.rgba[4 * i + 3] > 0.5f);
    return double(differing) / double(a.pixels());
}

// Standard deviations that a figure's noise counts for.
const double deviations = 3.0;

// The mean square error over pixels that each have noise s^2 subtracted varies by s^2 sqrt(2 / pixels).
double noiseOf(double standardError, size_t pixels)
{
    return pixels > 0 ? standardError * std::sqrt(deviations * std::sqrt(2.0 / double(pixels))) : 0.0;
}

// That of relMSE, whose pixels differ widely.
double relativeNoise(const Estimate& estimate, const Mask& mask, double meanLuminance)
{
    const double least = 1e-4 * meanLuminance * meanLuminance;
    double squares = 0.0;
    for (int y = 0; y < estimate.mean.height; ++y)
        for (int x = 0; x < estimate.mean.width; ++x) {
            if (!mask.at(x, y)) continue;
            double square = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double value = estimate.mean.color(x, y)[k], error = estimate.error.color(x, y)[k];
                square += error * error / (value * value + least) / 3.0;
            }
            squares += square * square;
        }
    return mask.pixels() > 0 ? std::sqrt(deviations * std::sqrt(2.0 * squares) / double(mask.pixels())) : 0.0;
}

// With noise of the estimate's own standard error added to it.
Picture noisier(const Estimate& estimate)
{
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    Picture result = estimate.mean;
    for (size_t i = 0; i < result.pixels(); ++i) {
        const float deviation = normal(random);
        for (size_t k = 0; k < 3; ++k) result.rgba[4 * i + k] += deviation * estimate.error.rgba[4 * i + k];
    }
    return result;
}

// Measures one scene under one map.
class Measurement
{
  public:
    Measurement(const SuiteScene& scene, const Variation& variation)
        : _lit(*scene.lit), _settings(*scene.lit->getSettings()), _renderer(width, height)
    {
        setCamera(scene, variation.orthographic, _renderer);
        _settings.bounce = Settings::BOUNCE_OFF;
        _settings.reflections = Settings::REFLECTIONS_MAP;
        for (const auto& [name, value] : settingsOfAllRows) apply(_settings, name, value);
        for (const auto& [name, value] : variation.settings) apply(_settings, name, value);
    }

    void run(Result& r)
    {
        look(r);
        const ErrorFigures e = errorOf(r.picture, r.inside);
        r.figures[REL_MSE] = e.relMse;
        r.noise[REL_MSE] = relativeNoise(_truth.beauty, r.inside, e.meanLuminance);
        r.figures[TONED] = e.tRmse;
        r.noise[TONED] = noiseOf(e.tNoise, e.pixels);
        r.figures[DISSIMILARITY] = dissimilarity(r.picture, r.stops);
        r.dissimilarNoise = dissimilarity(noisier(_truth.beauty), r.stops);
        r.figures[SILHOUETTE] = silhouette(r.picture, r.reference);
        for (Figure f : {DIFFUSE, SPECULAR, OCCLUSION}) std::tie(r.figures[f], r.noise[f]) = termError(f);
        runWithLess(r);
        runWithBounce(r);
    }

    TracedRow traced()
    {
        Result r;
        look(r);
        osg::Camera& camera = *_renderer.viewer().getCamera();
        const osgEnvLight::EnvironmentMap& map = *_lit.getEnvironmentMap();
        return {osgEnvLight::flattenScene(_lit, camera, _renderer.viewer().getFrameStamp()),
                osgEnvLight::RayCamera(camera, _lit.getBound()),
                osgEnvLight::MapEnvironment(*radianceOf(map), map.getRotation(), map.getIntensity()),
                r.picture,
                r.reference,
                r.inside,
                term(Settings::DIFFUSE),
                term(Settings::OCCLUSION),
                _deferred};
    }

  private:
    void look(Result& r)
    {
        r.picture = _renderer.render(&_lit);
        _truth = truthOf(_lit, _renderer.viewer());
        r.reference = _truth.beauty.mean;
        const Mask both = Mask::geometry(r.picture) & Mask::geometry(r.reference);
        r.inside = osgEnvLight::withoutEdges(both, surface(), _truth.depth);
        // The terms are those of what the passes light: transparent surfaces are drawn afterwards.
        _deferred = r.inside & Mask::unmarked(_truth.blended);
        r.stops = osgEnvLight::automaticExposure(r.reference, both);
    }

    // Normal and coverage.
    Picture surface() const
    {
        Picture p = _truth.normal;
        for (size_t i = 0; i < p.pixels(); ++i) p.rgba[4 * i + 3] = _truth.beauty.mean.rgba[4 * i + 3];
        return p;
    }

    ErrorFigures errorOf(const Picture& picture, const Mask& mask) const
    {
        return osgEnvLight::compare(picture, _truth.beauty.mean, _truth.beauty.error, mask);
    }

    void runWithBounce(Result& r)
    {
        const auto compare = [&](const Picture& picture) {
            return osgEnvLight::compare(picture, _truth.full.mean, _truth.full.error, r.inside);
        };
        r.withoutBounce = compare(r.picture).tRmse;
        _settings.bounce = Settings::BOUNCE_PROBES;
        _settings.reflections = Settings::REFLECTIONS_SCENE;
        const ErrorFigures e = compare(_renderer.render(&_lit));
        _settings.bounce = Settings::BOUNCE_OFF;
        _settings.reflections = Settings::REFLECTIONS_MAP;
        r.figures[BOUNCED] = e.tRmse;
        r.noise[BOUNCED] = noiseOf(e.tNoise, e.pixels);
    }

    double dissimilarity(const Picture& picture, double stops) const
    {
        const Picture& reference = _truth.beauty.mean;
        return 1.0 - osgEnvLight::mean(osgEnvLight::ssim(picture, reference, stops), Mask::geometry(reference));
    }

    Picture term(int view)
    {
        _settings.view = view;
        // S is compared unoccluded, and the suns' shadows are in it.
        const int visibility = _settings.visibility;
        if (view == Settings::SPECULAR) _settings.visibility = Settings::VISIBILITY_NONE;
        const Picture picture = _renderer.render(&_lit);
        _settings.visibility = visibility;
        _settings.view = Settings::BEAUTY;
        return picture;
    }

    // With its noise.
    std::pair<double, double> termError(Figure figure)
    {
        const Estimate& truth = figure == DIFFUSE ? _truth.diffuse : figure == SPECULAR ? _truth.specular : _truth.occlusion;
        const Picture picture = term(figure == DIFFUSE    ? Settings::DIFFUSE
                                     : figure == SPECULAR ? Settings::SPECULAR
                                                          : Settings::OCCLUSION);
        const ErrorFigures e = osgEnvLight::compare(picture, truth.mean, truth.error, _deferred);
        if (figure == SPECULAR) return {e.tRmse, noiseOf(e.tNoise, e.pixels)};
        const double light = osgEnvLight::compare(_truth.diffuse.mean, _truth.diffuse.mean, _deferred).mean;
        return light > 0.0 ? std::pair(e.rmse / light, noiseOf(e.noise, e.pixels) / light) : std::pair(0.0, 0.0);
    }

    void runWithLess(Result& r)
    {
        _settings.occlusion = false;
        r.withoutOcclusion = errorOf(_renderer.render(&_lit), r.inside).tRmse;
        _settings.occlusion = true;
        if (r.figures[SPECULAR] == 0.0) return;  // nothing glossy
        _settings.specularSamples /= 2;
        r.halfSamples = termError(SPECULAR).first;
        _settings.specularSamples *= 2;
    }

    osgEnvLight::LitScene& _lit;
    Settings& _settings;
    SceneRenderer _renderer;
    Truth _truth;
    Mask _deferred;
};

// Under its map; without a node if one of them is not installed.
SuiteScene sceneOf(const Row& row)
{
    SuiteScene scene = makeScene(row.scene);
    if (!scene.lit || !setMap(*scene.lit, row.map)) return SuiteScene();
    osgEnvLight::EnvironmentMap& map = *scene.lit->getEnvironmentMap();
    map.setRotation(map.getRotation() + row.variation.rotation);
    return scene;
}

Result measure(const Row& row)
{
    const auto start = std::chrono::steady_clock::now();
    Result r;
    const SuiteScene scene = sceneOf(row);
    if (!scene.lit) return r;
    r.installed = true;
    Measurement(scene, row.variation).run(r);
    r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return r;
}

}  // namespace

std::string Row::name() const
{
    const std::string base = std::string(scene) + "_" + map;
    return *variation.name ? base + "_" + variation.name : base;
}

namespace
{

std::map<const Row*, Result> results;

}  // namespace

bool hasResult(const Row& row)
{
    return results.count(&row) > 0;
}

void setForAllRows(const std::string& name, const std::string& value)
{
    apply(*osg::ref_ptr<Settings>(new Settings), name, value);
    settingsOfAllRows.emplace_back(name, value);
}

const Result& result(const Row& row)
{
    const auto found = results.find(&row);
    return found != results.end() ? found->second : results.emplace(&row, measure(row)).first->second;
}

std::optional<TracedRow> traced(const Row& row)
{
    const SuiteScene scene = sceneOf(row);
    if (!scene.lit) return std::nullopt;
    return Measurement(scene, row.variation).traced();
}

}  // namespace suite
