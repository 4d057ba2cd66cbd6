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
#include <stdexcept>

namespace suite
{

using osgEnvLight::ErrorFigures;
using osgEnvLight::Layer;
using osgEnvLight::Mask;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

const char* const figureNames[NUM_FIGURES] = {"relMSE", "tRMSE", "1-SSIM", "D", "S", "O", "silhouette"};

namespace
{

const char* const cacheFolder = ENVLIGHT_BINARY_DIR "/references";

// A layer and its standard error.
struct Estimate {
    Picture mean;
    Picture error;
};

struct Truth {
    Estimate beauty, diffuse, specular, occlusion;
    Picture normal;
    Picture depth;
    Picture blended;
};

ReferenceOptions referenceOptions()
{
    ReferenceOptions o;
    o.paths = ReferenceOptions::DIRECT;
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
    const osgEnvLight::ReferenceResult result = reference.render(referenceOptions(), layers);
    ReferenceCache::Pictures pictures;
    for (Layer layer : sampledLayers) {
        pictures.push_back(result.mean(layer));
        pictures.push_back(result.standardError(layer));
    }
    for (Layer layer : exactLayers) pictures.push_back(result.mean(layer));
    return pictures;
}

// The scene as the viewer's camera saw it in its last frame.
Truth truthOf(osgEnvLight::LitScene& lit, osgViewer::Viewer& viewer)
{
    osg::Camera& camera = *viewer.getCamera();
    const osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    std::string error;
    const osg::ref_ptr<const osgEnvLight::RadianceMap> radiance = map.radiance(error);
    if (!radiance) throw std::runtime_error(error);
    const osgEnvLight::TriangleScene triangles = osgEnvLight::flattenScene(lit, camera, viewer.getFrameStamp());

    ContentHash hash;
    hash.file(ENVLIGHT_REFERENCE_LIBRARY);  // its code
    hash.scene(triangles);
    hash.camera(camera.getViewMatrix(), camera.getProjectionMatrix(), width, height);
    hash.map(*radiance, map.getRotation(), map.getIntensity());
    hash.options(referenceOptions());

    const ReferenceCache::Pictures p = ReferenceCache(cacheFolder).get(hash.get(), [&] {
        return trace(triangles, osgEnvLight::RayCamera(camera, lit.getBound()),
                     osgEnvLight::MapEnvironment(*radiance, map.getRotation(), map.getIntensity()));
    });
    return {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}, p[8], p[9], p[10]};
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

// Measures one scene under one map.
class Measurement
{
  public:
    Measurement(const SuiteScene& scene, const Variation& variation)
        : _lit(*scene.lit), _settings(*scene.lit->getSettings()), _renderer(width, height)
    {
        setCamera(scene, variation.orthographic, _renderer);
        for (const auto& [name, value] : variation.settings) {
            std::string error;
            if (!_settings.set(name, value, error)) throw std::runtime_error(error);
        }
    }

    void run(Result& r)
    {
        _renderer.render(&_lit);  // the second frame has all textures and shaders
        r.picture = _renderer.render(&_lit);
        _truth = truthOf(_lit, _renderer.viewer());
        r.reference = _truth.beauty.mean;
        const Mask both = Mask::geometry(r.picture) & Mask::geometry(r.reference);
        r.inside = osgEnvLight::withoutEdges(both, surface(), _truth.depth);
        // The terms are those of what the passes light: transparent surfaces are drawn afterwards.
        _deferred = r.inside & Mask::unmarked(_truth.blended);
        r.stops = osgEnvLight::automaticExposure(r.reference, both);
        const ErrorFigures e = errorOf(r.picture, r.inside);
        r.figures[REL_MSE] = e.relMse;
        r.figures[TONED] = e.tRmse;
        r.noise = e.tNoise;
        r.figures[DISSIMILARITY] =
            1.0 - osgEnvLight::mean(osgEnvLight::ssim(r.picture, r.reference, r.stops), Mask::geometry(r.reference));
        r.figures[SILHOUETTE] = silhouette(r.picture, r.reference);
        r.figures[DIFFUSE] = termError(Settings::DIFFUSE);
        r.figures[SPECULAR] = termError(Settings::SPECULAR);
        r.figures[OCCLUSION] = termError(Settings::OCCLUSION);
        runWithLess(r);
    }

  private:
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

    double termError(Settings::View view)
    {
        _settings.view = view;
        const Picture picture = _renderer.render(&_lit);
        _settings.view = Settings::BEAUTY;
        const Estimate& truth = view == Settings::DIFFUSE    ? _truth.diffuse
                                : view == Settings::SPECULAR ? _truth.specular
                                                             : _truth.occlusion;
        const ErrorFigures e = osgEnvLight::compare(picture, truth.mean, truth.error, _deferred);
        if (view == Settings::SPECULAR) return e.tRmse;
        const double light = osgEnvLight::compare(_truth.diffuse.mean, _truth.diffuse.mean, _deferred).mean;
        return light > 0.0 ? e.rmse / light : 0.0;
    }

    void runWithLess(Result& r)
    {
        _settings.occlusion = false;
        r.withoutOcclusion = errorOf(_renderer.render(&_lit), r.inside).tRmse;
        _settings.occlusion = true;
        _settings.occlusionSteps /= 2;
        r.halfSteps = termError(Settings::OCCLUSION);
        _settings.occlusionSteps *= 2;
        _settings.specularSamples /= 2;
        r.halfSamples = termError(Settings::SPECULAR);
        _settings.specularSamples *= 2;
    }

    osgEnvLight::LitScene& _lit;
    Settings& _settings;
    SceneRenderer _renderer;
    Truth _truth;
    Mask _deferred;
};

Result measure(const Row& row)
{
    const auto start = std::chrono::steady_clock::now();
    Result r;
    const SuiteScene scene = makeScene(row.scene);
    if (!scene.lit || !setMap(*scene.lit, row.map)) return r;
    osgEnvLight::EnvironmentMap& map = *scene.lit->getEnvironmentMap();
    map.setRotation(map.getRotation() + row.variation.rotation);
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

const Result& result(const Row& row)
{
    static std::map<const Row*, Result> results;
    const auto found = results.find(&row);
    return found != results.end() ? found->second : results.emplace(&row, measure(row)).first->second;
}

}  // namespace suite
