// SPDX-License-Identifier: MIT
#include "Measurement.h"

#include <algorithm>
#include <map>

namespace tradeoff
{

namespace
{

using osgEnvLight::Layer;
using osgEnvLight::Picture;
using osgEnvLight::Settings;

const int warmUp = 2;
const double instant = 1.0 / 30.0;  // of the reference: the scene stands still
// Of one set of settings, so that slow ones don't hold up the rest.
const double longest = 20000.0;

// Linear between the two nearest.
double quantile(const std::vector<double>& sorted, double q)
{
    const double at = q * double(sorted.size() - 1);
    const size_t i = std::min(size_t(at), sorted.size() - 1);
    const size_t j = std::min(i + 1, sorted.size() - 1);
    return sorted[i] + (at - double(i)) * (sorted[j] - sorted[i]);
}

Spread spreadOf(std::vector<double> values)
{
    Spread s;
    if (values.empty()) return s;
    std::sort(values.begin(), values.end());
    s.median = quantile(values, 0.5);
    s.low = quantile(values, 0.1);
    s.high = quantile(values, 0.9);
    s.frames = int(values.size());
    return s;
}

}  // namespace

Measurement::Measurement(osgEnvLight::LitScene& lit, HeadlessViewer& viewer, const Truth& truth, int frames)
    : _lit(lit), _viewer(viewer), _truth(truth), _base(new Settings(*lit.getSettings())), _frames(frames)
{
    _lit.setTimed(true);
    _viewer.draw(0.0);
}

std::string Measurement::statement() const
{
    return "Median of " + std::to_string(_frames) + " frames (fewer where they take longer than " +
           std::to_string(int(longest / 1000.0)) + " s together), with the 10th and 90th percentile, after " +
           std::to_string(warmUp) +
           " frames that warm up and whatever it takes until the map's lights are made. A frame is wall-clock time until the GPU "
           "is "
           "done; a pass is a GPU timer query where the driver has them, else CPU time.";
}

void Measurement::time(Point& point)
{
    double warm = 0.0;
    for (int i = 0; i < warmUp || _lit.regenerating(); ++i) warm = _viewer.draw(instant);
    const int frames = std::clamp(int(longest / std::max(warm, 1e-3)), 3, _frames);
    std::vector<double> times;
    std::vector<std::string> order;
    std::map<std::string, std::vector<double>> passes;
    for (int i = 0; i < frames; ++i) {
        times.push_back(_viewer.draw(instant));
        // A query is read a frame late: the first is that of a frame that warmed up, which is as good.
        for (const auto& pass : _lit.plan().passes) {
            if (pass.cpu < 0.0) continue;
            if (passes.find(pass.pass) == passes.end()) order.push_back(pass.pass);
            passes[pass.pass].push_back(pass.gpu >= 0.0 ? pass.gpu : pass.cpu);
        }
    }
    point.frame = spreadOf(times);
    for (const std::string& pass : order) point.passes.emplace_back(pass, spreadOf(passes[pass]));
}

Picture Measurement::view(int view)
{
    _lit.getSettings()->view = view;
    _viewer.draw(instant);
    return _viewer.picture();
}

// S before anything occludes it: that of settings which S does not ask for is drawn once, since a view that asks for no
// visibility forgets its shadow maps.
const Picture& Measurement::specular()
{
    Settings& s = *_lit.getSettings();
    const auto [known, isNew] = _speculars.try_emplace(std::make_tuple(s.specular, s.specularMethod, s.specularSamples, s.suns, s.filterCells));
    if (!isNew) return known->second;
    const int visibility = s.visibility;
    s.visibility = Settings::VISIBILITY_NONE;
    known->second = view(Settings::SPECULAR);
    s.visibility = visibility;
    return known->second;
}

Point Measurement::measure(const Candidate& candidate)
{
    Point point;
    point.sweep = candidate.sweep;
    point.value = candidate.value;
    point.number = candidate.number;
    try {
        apply(candidate, *_base, *_lit.getSettings(), point.settings);
        time(point);
        _pictures.beauty = _viewer.picture();
        _pictures.diffuse = view(Settings::DIFFUSE);
        _pictures.occlusion = view(Settings::OCCLUSION);
        _pictures.specular = specular();
        _lit.getSettings()->view = _base->view;
        if (!_pictures.beauty.finite()) throw std::runtime_error("the picture has values that are not finite");
        point.beauty = figuresOf(_pictures.beauty, _truth, Layer::BEAUTY);
        point.terms["diffuse"] = figuresOf(_pictures.diffuse, _truth, Layer::DIFFUSE);
        point.terms["specular"] = figuresOf(_pictures.specular, _truth, Layer::SPECULAR);
        point.terms["occlusion"] = figuresOf(_pictures.occlusion, _truth, Layer::OCCLUSION);
    } catch (const std::exception& error) {
        point.failed = true;
        point.failure = error.what();
    }
    return point;
}

}  // namespace tradeoff
