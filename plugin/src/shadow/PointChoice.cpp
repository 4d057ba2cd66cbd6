// SPDX-License-Identifier: MIT
#include "shadow/PointChoice.h"

#include "base/R2Points.h"

#include <osg/Math>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace osgEnvLight
{

namespace
{

// Of the weights: by flux.
const double fluxShare = 0.1;
// Of a side at most.
const unsigned mostParts = 16;
// Half the width of their maps' windows at distance 1. What lies beside that counts as seen, and in a street most lamps are far
// off and behind houses: with 2, 4, 6, 8 a city has an error (tRMSE) of 4.8, 3.7, 3.2, 2.9 % [tests/bench/area_study].
const double wideTangent = 8.0;
// Lights times places that are looked at, at most: a choice among 10^4 lights takes 2.3 ms.
const size_t mostPairs = 200000;
const size_t leastPlaces = 8;

const size_t noSide = std::numeric_limits<size_t>::max();

// In (0, 1): that of a part stays, neighbours' differ, and any range of numbers has them evenly [van der Corput].
double ownNumber(size_t side, unsigned part, unsigned round)
{
    double u = 0.0, digit = 0.5;
    for (size_t i = side; i > 0; i /= 2, digit *= 0.5) u += digit * double(i % 2);
    const double shift = round == 0 ? 0.0 : r2Point(round)[0];
    return std::max(wrapped(u + 0.61803398874989485 * part + shift), 1e-9);
}

// What a side sends to a place whatever faces it there.
double sentTo(const LitSide& side, const osg::Vec3d& place)
{
    const osg::Vec3d to = place - side.light->center;
    const double square = std::max(to.length2(), 1e-300);
    const double cosine =
        side.light->shape == AreaLight::SPHERE ? 0.25 : side.light->normal * to * side.turned / std::sqrt(square);
    return side.flux * std::max(cosine, 0.0) / (osg::PI * square + side.light->area);
}

void normalise(std::vector<double>& weights, double total)
{
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (sum > 0.0)
        for (double& w : weights) w *= total / sum;
}

struct Candidate {
    ChosenPart chosen;
    double weight, priority;
};

// Parts of a side: as many as points would stand for it, to a power of two, so that they stay while it changes a little.
unsigned partsOf(double share)
{
    unsigned parts = 1;
    while (parts < mostParts && 2.0 * parts <= share) parts *= 2;
    return parts;
}

}  // namespace

std::vector<double> weightsByFlux(const std::vector<LitSide>& sides)
{
    std::vector<double> weights;
    for (const LitSide& side : sides) weights.push_back(side.flux);
    normalise(weights, 1.0);
    return weights;
}

std::vector<double> weightsAt(const std::vector<LitSide>& sides, const std::vector<osg::Vec3d>& places)
{
    std::vector<double> weights(sides.size(), 0.0), row(sides.size());
    for (const osg::Vec3d& place : places) {
        for (size_t i = 0; i < sides.size(); ++i) row[i] = sentTo(sides[i], place);
        normalise(row, 1.0);
        for (size_t i = 0; i < sides.size(); ++i) weights[i] += row[i];
    }
    normalise(weights, 1.0 - fluxShare);
    std::vector<double> byFlux = weightsByFlux(sides);
    for (size_t i = 0; i < sides.size(); ++i) weights[i] += fluxShare * byFlux[i];
    return weights;
}

std::vector<ChosenPart> chooseParts(const std::vector<double>& weights, unsigned count, unsigned round)
{
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<Candidate> candidates;
    for (size_t i = 0; i < weights.size(); ++i) {
        const unsigned parts = partsOf(weights[i] / total * count);
        const double weight = weights[i] / parts;
        for (unsigned k = 0; k < parts; ++k)
            candidates.push_back({{i, {k, parts}, 0.0}, weight, weight / ownNumber(i, k, round)});
    }
    // The most urgent that is not chosen: all those chosen stand for that much at least.
    const auto first = [](const Candidate& a, const Candidate& b) { return a.priority > b.priority; };
    double threshold = 0.0;
    if (candidates.size() > count) {
        std::nth_element(candidates.begin(), candidates.begin() + count, candidates.end(), first);
        threshold = candidates[count].priority;
        candidates.resize(count);
    }
    std::sort(candidates.begin(), candidates.end(), first);
    // The others share what is left by those that stand for themselves alone.
    double left = total, shares = 0.0;
    for (const Candidate& c : candidates) {
        if (c.weight < threshold)
            shares += 1.0;
        else
            left -= c.weight;
    }
    std::vector<ChosenPart> chosen;
    for (Candidate& c : candidates) {
        c.chosen.scale = c.weight < threshold ? left / shares / c.weight : 1.0;
        chosen.push_back(c.chosen);
    }
    return chosen;
}

namespace
{

std::vector<EmitterPoint> pointsOfParts(const std::vector<LitSide>& sides, const std::vector<ChosenPart>& parts, unsigned round)
{
    std::vector<EmitterPoint> points;
    for (const ChosenPart& c : parts) {
        if (c.side == noSide) {
            points.push_back(darkPoint());
            continue;
        }
        EmitterPoint point = pointOf(sides[c.side], c.part, pointShift(round));
        point.power *= c.scale;
        point.even *= c.scale;
        point.area *= c.scale;
        point.lightNumber = 1 + unsigned(c.side) * 2 * mostParts + c.part.parts + c.part.part;
        points.push_back(point);
    }
    return points;
}

}  // namespace

std::vector<EmitterPoint> chosenPoints(const std::vector<LitSide>& sides, const std::vector<double>& weights, unsigned count,
                                       unsigned round)
{
    std::vector<EmitterPoint> points = pointsOfParts(sides, chooseParts(weights, count, round), round);
    points.resize(count, darkPoint());
    placeMaps(points, wideTangent);
    return points;
}

std::vector<double> PointChoice::weightsOf(const std::vector<LitSide>& sides) const
{
    if (_places.empty()) return weightsByFlux(sides);
    const size_t most = std::max(mostPairs / std::max<size_t>(sides.size(), 1), leastPlaces);
    const size_t step = (_places.size() + most - 1) / most;
    std::vector<osg::Vec3d> some;
    for (size_t i = step / 2; i < _places.size(); i += step) some.push_back(_places[i]);
    return weightsAt(sides, some);
}

void PointChoice::choose(const std::vector<LitSide>& sides, unsigned count)
{
    if (sides.size() != _sides || count != _shown.size()) _shown.assign(count, {noSide, {}, 0.0});
    _sides = sides.size();
    _wanted = chooseParts(weightsOf(sides), count, 0);
}

// Those chosen that are shown stay, with the share that they have now.
void PointChoice::exchange(unsigned budget)
{
    std::vector<const ChosenPart*> missing;
    std::vector<bool> stays(_shown.size(), false);
    for (const ChosenPart& wanted : _wanted) {
        const auto same = std::find_if(_shown.begin(), _shown.end(), [&](const ChosenPart& s) { return s.isOf(wanted); });
        if (same == _shown.end()) {
            missing.push_back(&wanted);
            continue;
        }
        same->scale = wanted.scale;
        stays[size_t(same - _shown.begin())] = true;
    }
    // A light's parts side by side; the most urgent lights first, as far as one sees.
    std::stable_sort(missing.begin(), missing.end(), [](const ChosenPart* a, const ChosenPart* b) {
        return a->part.parts != b->part.parts ? a->part.parts > b->part.parts : a->part.parts > 1 && a->side < b->side;
    });
    _changed = 0;
    size_t next = 0;
    const auto freeNumber = [&] {
        while (next < _shown.size() && stays[next]) ++next;
        return next;
    };
    for (size_t k = 0; k < missing.size(); ++k) {
        const bool begins = k == 0 || missing[k]->side != missing[k - 1]->side;
        if (begins && _changed >= budget) break;
        // Other parts of the same light would count it twice.
        if (begins)
            for (size_t i = 0; i < _shown.size(); ++i)
                if (!stays[i] && _shown[i].side == missing[k]->side) _shown[i].side = noSide;
        _shown[freeNumber()] = *missing[k];
        stays[next] = true;
        ++_changed;
    }
    _waiting = unsigned(missing.size()) - _changed;
}

const std::vector<EmitterPoint>& PointChoice::update(const std::vector<Emitter>& lights, unsigned count,
                                                     const std::vector<osg::Vec3d>* places, unsigned budget)
{
    const bool differs = lights != _lights || count != _shown.size();
    if (places) _places = *places;
    if (differs) _lights = lights;
    if (!differs && !places && _waiting == 0) {
        _changed = 0;
        return _points;
    }
    const std::vector<LitSide> sides = litSides(_lights);
    const bool isFirst = sides.size() != _sides || count != _shown.size();
    if (differs || places) choose(sides, count);
    exchange(isFirst ? count : budget);
    _points = pointsOfParts(sides, _shown, 0);
    placeMaps(_points, wideTangent);
    return _points;
}

std::vector<unsigned char> PointChoice::sidesWithPoints() const
{
    const std::vector<LitSide> sides = litSides(_lights);
    std::vector<unsigned char> pointed(2 * _lights.size(), 0);
    for (const ChosenPart& c : _shown) {
        if (c.side == noSide) continue;
        const LitSide& side = sides[c.side];
        pointed[size_t(side.light - _lights.data()) * 2 + (side.turned < 0.0 ? 1 : 0)] = 1;
    }
    return pointed;
}

std::vector<EmitterPoint> PointChoice::ofRound(const std::vector<Emitter>& lights, unsigned count, unsigned round) const
{
    const std::vector<LitSide> sides = litSides(lights);
    return chosenPoints(sides, weightsOf(sides), count, round);
}

}  // namespace osgEnvLight
