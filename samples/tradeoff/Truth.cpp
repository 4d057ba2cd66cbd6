// SPDX-License-Identifier: MIT
#include "Truth.h"

#include "Numbers.h"

#include <metrics/Display>
#include <metrics/Flip>
#include <metrics/Metrics>
#include <metrics/Ssim>

#include <chrono>
#include <cmath>
#include <sstream>

namespace tradeoff
{

namespace
{

using osgEnvLight::Layer;
using osgEnvLight::Mask;
using osgEnvLight::Picture;
using osgEnvLight::ReferenceOptions;

std::string statementOf(const osgEnvLight::ReferenceResult& result, const TruthOptions& options)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << "Ray traced (Embree), " << (options.full ? "full light transport" : "direct light with visibility") << ", "
         << result.samples << " samples per pixel by multiple importance sampling in " << std::lround(result.seconds)
         << " s; its standard error is " << percent(result.relativeError(Layer::BEAUTY))
         << " of the picture's mean, and is subtracted from every error.";
    return text.str();
}

}  // namespace

Truth makeTruth(const ReferenceScene& scene, const TruthOptions& options, const std::function<bool(double, double)>& progress)
{
    ReferenceOptions reference;
    reference.paths = options.full ? ReferenceOptions::FULL : ReferenceOptions::DIRECT;
    reference.estimator = ReferenceOptions::MIS;
    reference.samples = 1u << 20;
    reference.pass = 8;  // eight of them say how uncertain it is: 64 samples at least
    reference.error = options.error;
    reference.occlusionReach = options.reach;
    std::set<Layer> layers = {
        Layer::BEAUTY,   Layer::DIFFUSE,          Layer::SPECULAR,          Layer::OCCLUSION,     Layer::SPECULAR_VISIBLE,
        Layer::INDIRECT, Layer::OCCLUSION_HIDDEN, Layer::OCCLUSION_OUTSIDE, Layer::OCCLUSION_FAR, Layer::NORMAL,
        Layer::DEPTH,    Layer::BLENDED};
    const auto start = std::chrono::steady_clock::now();
    bool cancelled = false;
    const osgEnvLight::ReferenceResult result = scene.reference().render(reference, layers, [&](const auto& p) {
        const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        cancelled = !progress(std::max(p.fraction, elapsed / options.seconds), p.error);
        // At least two passes, or nothing is known of its noise.
        return !cancelled && (elapsed < options.seconds || p.samples < 2 * reference.pass);
    });
    Truth truth;
    truth.full = options.full;
    truth.interrupted = cancelled;
    for (Layer layer : layers) {
        truth.means[layer] = result.mean(layer);
        truth.standardErrors[layer] = result.standardError(layer);
    }
    truth.mask = withoutEdges(Mask::geometry(truth[Layer::BEAUTY]), truth[Layer::NORMAL], truth[Layer::DEPTH]);
    truth.deferred = truth.mask & Mask::unmarked(truth[Layer::BLENDED]);
    truth.exposure = osgEnvLight::automaticExposure(truth[Layer::BEAUTY], truth.mask);
    truth.statement = statementOf(result, options);
    return truth;
}

Figures figuresOf(const Picture& picture, const Truth& truth, Layer layer)
{
    const osgEnvLight::ErrorFigures f = compare(picture, truth[layer], truth.standardErrors.at(layer), truth.maskOf(layer));
    Figures figures;
    figures.tRMSE = f.tRmse;
    figures.relMSE = f.relMse;
    figures.rmse = f.rmse;
    figures.bias = f.bias * f.mean;
    figures.p99 = f.p99 * f.meanLuminance;
    figures.noise = f.tNoise;
    figures.resolved = f.resolved;
    if (layer != Layer::BEAUTY) return figures;
    figures.ssim = mean(ssim(picture, truth[layer], truth.exposure), truth.mask);
    figures.flip = mean(flip(picture, truth[layer], truth.exposure), truth.mask);
    return figures;
}

}  // namespace tradeoff
