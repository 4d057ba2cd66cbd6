// SPDX-License-Identifier: MIT
#include "lights/LightStream.h"

#include "lights/AutoSampler.h"
#include "lights/LightClusters.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const unsigned fadeSteps = 8;
const double newMap = 0.25;  // of the flux: beyond it's another map, not a change of the last

osg::ref_ptr<const LightSampler> samplerOf(const MapOptions& options)
{
    return LightSampler::create(LightSampler::names()[size_t(options.sampler)]);
}

MomentTable tableOf(const RadianceMap& map, unsigned count, const MapOptions& options)
{
    return MomentTable(map, MomentTable::columnsFor(count), options.sampling.floor);
}

// Flux per channel in cells of 11 degrees.
std::vector<double> coarseFlux(const MomentTable& table)
{
    std::vector<double> flux;
    const int columns = std::min(32, table.width());
    const int rows = std::min(16, table.height());
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const osg::Vec3d rgb = table
                                       .region(double(table.width()) * x / columns, double(table.height()) * y / rows,
                                               double(table.width()) * (x + 1) / columns, double(table.height()) * (y + 1) / rows)
                                       .rgb;
            flux.insert(flux.end(), {rgb[0], rgb[1], rgb[2]});
        }
    return flux;
}

double change(const std::vector<double>& a, const std::vector<double>& b)
{
    if (a.size() != b.size()) return 1.0;
    double difference = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        difference += std::abs(a[i] - b[i]);
        sum += std::max(a[i], b[i]);
    }
    return sum > 0.0 ? difference / sum : 0.0;
}

// The eighth in which a slot is taken over: spread over blocks and groups alike.
unsigned eighth(size_t slot)
{
    return unsigned((slot + slot / 16) % fadeSteps);
}

}  // namespace

LightList LightStream::cold(const RadianceMap& map, unsigned count, const MapOptions& options) const
{
    const LightList list = options.given ? *options.given : samplerOf(options)->sample(map, count, options.sampling);
    return _order == DEALT ? dealt(list, options.deal) : list;
}

void LightStream::start(const RadianceMap& map, unsigned count, const MapOptions& options)
{
    _lights = cold(map, count, options);
    _count = count;
    _options = options;
    _coarse = coarseFlux(tableOf(map, count, options));
    _generators.clear();
    for (const DirectionalLight& l : _lights) _generators.push_back(l.direction);
    _target.clear();
    _teleported = -1;
    _settled = true;
}

bool LightStream::goesOn(const RadianceMap& map, unsigned count, const MapOptions& options) const
{
    return !options.given && options.sampler == Settings::SAMPLER_AUTO && count <= AutoSampler::largestRefined &&
           count == _count && options.sameLists(_options) && !_lights.empty() && map.meanOfChannels() > 0.0;
}

const LightList& LightStream::next(const RadianceMap& map, unsigned count, const MapOptions& options)
{
    if (!goesOn(map, count, options)) {
        start(map, count, options);
        return _lights;
    }
    const MomentTable table = tableOf(map, count, options);
    std::vector<double> coarse = coarseFlux(table);
    if (change(coarse, _coarse) > newMap) {
        _target = cold(map, count, options);
        _targetMap = &map;
        _taken = 0;
    }
    _coarse = std::move(coarse);
    step(map, table, false);
    return _lights;
}

const LightList& LightStream::settle(const RadianceMap& map, unsigned count, const MapOptions& options)
{
    if (!goesOn(map, count, options)) {
        start(map, count, options);
    } else if (!_settled) {
        if (_target.empty() || _targetMap != &map) {
            _target = cold(map, count, options);
            _targetMap = &map;
            _taken = 0;
        }
        step(map, tableOf(map, count, options), true);
    }
    return _lights;
}

void LightStream::step(const RadianceMap& map, const MomentTable& table, bool still)
{
    _teleported = -1;
    _settled = false;
    const bool fading = !_target.empty();
    if (fading) {
        for (size_t i = 0; i < _generators.size(); ++i)
            if (eighth(i) == _taken) _generators[i] = _target[i].direction;
        if (++_taken == fadeSteps) {
            _settled = still;
            if (still) _lights = std::move(_target);
            _target.clear();
            _targetMap = nullptr;
        }
    }
    if (_settled) {
        for (size_t i = 0; i < _generators.size(); ++i) _generators[i] = _lights[i].direction;
        return;
    }
    LightClusters clusters(table, _generators);
    clusters.refine(1);
    if (!fading) _teleported = clusters.teleport();
    if (_teleported >= 0) clusters.refine(1);
    _generators = clusters.generators();
    _lights = clusters.lights();
    scaleToFlux(_lights, map.flux);
    if (_options.sampling.weights != SampleOptions::WEIGHTS_OFF) matchHarmonics(_lights, map);
}

}  // namespace osgEnvLight
