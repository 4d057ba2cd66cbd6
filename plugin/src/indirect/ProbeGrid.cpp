// SPDX-License-Identifier: MIT
#include "indirect/ProbeGrid.h"

#include "base/Limits.h"
#include "indirect/StoppedRay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

constexpr int depthSide = limits::PROBE_DEPTH_SIDE;
constexpr double finer = 3.0;  // a level about the focus than the one about it

// Texels of the depth map and the rays that each averages, by cos^40 of the angle between [indirect.md 4].
struct DepthTexel {
    std::vector<std::pair<unsigned, float>> rays;
};

std::vector<DepthTexel> makeDepthTexels()
{
    std::vector<DepthTexel> texels(size_t(depthSide * depthSide));
    const auto& rays = ProbeGrid::directions();
    for (int i = 0; i < depthSide * depthSide; ++i) {
        const glsl::vec3 d = glsl::directionFromOctahedral((glsl::vec2(i % depthSide, i / depthSide) + 0.5) / double(depthSide));
        for (unsigned k = 0; k < rays.size(); ++k) {
            const double c = d.x * double(rays[k].to.x()) + d.y * double(rays[k].to.y()) + d.z * double(rays[k].to.z());
            if (c > 0.5) texels[size_t(i)].rays.emplace_back(k, float(std::pow(c, 40.0)) * rays[k].share);
        }
    }
    return texels;
}

std::vector<ProbeGrid::Direction> makeDirections()
{
    const int side = limits::PROBE_FACE_SIDE;
    std::vector<ProbeGrid::Direction> all;
    double sum = 0.0;
    for (int i = 0; i < 6 * side * side; ++i) {
        const int face = i / (side * side);
        const auto at = [&](const osg::Vec2f& inTexel) {
            osg::Vec3f d;
            d[face / 2] = face % 2 ? -1.0f : 1.0f;
            d[(face / 2 + 1) % 3] = 2.0f * (float(i % side) + inTexel.x()) / float(side) - 1.0f;
            d[(face / 2 + 2) % 3] = 2.0f * (float(i / side % side) + inTexel.y()) / float(side) - 1.0f;
            return d;
        };
        const auto unit = [&](float x, float y) {
            osg::Vec3f d = at(osg::Vec2f(x, y));
            d.normalize();
            return d;
        };
        const float length = at(osg::Vec2f(0.5f, 0.5f)).length();
        all.push_back(
            {unit(0.5f, 0.5f), 1.0f / (length * length * length), {unit(0.2f, 0.3f), unit(0.8f, 0.2f), unit(0.45f, 0.85f)}});
        sum += double(all.back().share);
    }
    for (ProbeGrid::Direction& d : all) d.share = float(double(d.share) / sum);
    return all;
}

struct Extent {
    float low, high;
};

// Of each direction the one that is most nearly opposite.
std::vector<size_t> makeOpposites()
{
    const std::vector<ProbeGrid::Direction>& all = ProbeGrid::directions();
    std::vector<size_t> opposites;
    for (const ProbeGrid::Direction& d : all)
        opposites.push_back(size_t(std::min_element(all.begin(), all.end(),
                                                    [&](const ProbeGrid::Direction& a, const ProbeGrid::Direction& b) {
                                                        return a.to * d.to < b.to * d.to;
                                                    }) -
                                   all.begin()));
    return opposites;
}

// Where the planes of a grid cross an axis: half of them evenly spread, half as the triangles are, so that a ground far and wide
// takes few of the probes.
std::vector<float> planesAlong(const std::vector<Extent>& triangles, const Extent& all, int count)
{
    const int bins = 256, least = std::max(bins / count, 1);  // what is flat counts for a cell about it: no planes fall together
    std::vector<double> density(size_t(bins) + 1, 0.0);       // as differences
    for (const Extent& t : triangles) {
        const float scale = float(bins) / (all.high - all.low);
        int first = std::clamp(int((t.low - all.low) * scale), 0, bins - 1);
        int last = std::clamp(int((t.high - all.low) * scale), first, bins - 1) + 1;
        if (last - first < least) {
            first = std::clamp((first + last - least) / 2, 0, bins - least);
            last = first + least;
        }
        density[size_t(first)] += 1.0 / (last - first);
        density[size_t(last)] -= 1.0 / (last - first);
    }
    std::partial_sum(density.begin(), density.end(), density.begin());
    std::vector<float> planes;
    double before = 0.0;
    for (int bin = 0; bin < bins; ++bin) {
        const double share = 0.5 / bins + 0.5 * density[size_t(bin)] / double(triangles.size());
        while (int(planes.size()) < count && (double(planes.size()) + 0.5) / count <= before + share) {
            const double within = ((double(planes.size()) + 0.5) / count - before) / share;
            planes.push_back(all.low + (all.high - all.low) * float((bin + within) / bins));
        }
        before += share;
    }
    return planes;
}

osg::BoundingBoxf boundOf(const TracedScene& scene)
{
    osg::BoundingBoxf box;
    for (size_t i = 0; i < scene.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner) box.expandBy(scene.corner(i, corner));
    return box;
}

// Of a level's planes.
std::array<int, 3> countsFor(const osg::BoundingBoxf& scene, int most)
{
    const osg::Vec3f size = scene._max - scene._min;
    const size_t shortest = size.z() <= size.x() && size.z() <= size.y() ? 2 : size.y() <= size.x() ? 1 : 0;
    std::array<int, 3> counts = {most, most, most};
    counts[shortest] = std::max(most / 2, 1);
    return counts;
}

// @param box  of the scene
ProbeGrid::Planes planesFor(const TracedScene& scene, const osg::BoundingBoxf& box, int most)
{
    const osg::Vec3f size = box._max - box._min;
    const std::array<int, 3> counts = countsFor(box, most);
    const float least = 0.02f * size.length() + 1e-20f;  // a plane's box has a height, too
    ProbeGrid::Planes planes;
    std::vector<Extent> triangles(scene.triangles.size());
    for (int k = 0; k < 3; ++k) {
        for (size_t i = 0; i < triangles.size(); ++i) {
            const auto [low, high] = std::minmax({scene.corner(i, 0)[k], scene.corner(i, 1)[k], scene.corner(i, 2)[k]});
            triangles[i] = {low, high};
        }
        const float more = 0.5f * std::max(least - size[k], 0.0f);
        planes[size_t(k)] = planesAlong(triangles, {box._min[k] - more, box._max[k] + more}, counts[size_t(k)]);
    }
    return planes;
}

// @param side  of its box, where that has most probes
ProbeGrid::Level latticeAbout(const osg::Vec3d& center, double side, const osg::BoundingBoxf& scene, int most)
{
    const double cell = side / std::max(most - 1, 1);
    const std::array<int, 3> counts = countsFor(scene, most);
    ProbeGrid::Level level;
    level.cell = float(cell);
    for (size_t k = 0; k < 3; ++k) {
        // As the planes of all the scene, half a cell within its bound. Nothing lies beyond that.
        const double low = double(scene._min[int(k)]), last = (double(scene._max[int(k)]) - low) / cell - counts[k];
        const double wanted = (center[int(k)] - low) / cell - 0.5 * counts[k];
        const double first = std::round(last > 0.0 ? std::clamp(wanted, 0.0, last) : 0.5 * last);
        for (int i = 0; i < counts[k]; ++i) level.planes[k].push_back(float(low + (first + i + 0.5) * cell));
        level.ends[k] = {first <= 0.0, first >= last - 0.5};
    }
    return level;
}

// Cells between the planes about one of them.
struct Spacing {
    float least = std::numeric_limits<float>::max();
    osg::Vec3f widest;
};

Spacing spacingAt(const ProbeGrid::Planes& planes, const std::array<int, 3>& at)
{
    Spacing spacing;
    for (size_t k = 0; k < 3; ++k) {
        const std::vector<float>& p = planes[k];
        const auto i = size_t(at[k]);
        for (const size_t upper : {i, i + 1}) {
            if (upper == 0 || upper == p.size()) continue;
            const float cell = p[upper] - p[upper - 1];
            spacing.least = std::min(spacing.least, cell);
            spacing.widest[int(k)] = std::max(spacing.widest[int(k)], cell);
        }
    }
    return spacing;
}

}  // namespace

const std::vector<ProbeGrid::Direction>& ProbeGrid::directions()
{
    static const std::vector<Direction> all = makeDirections();
    return all;
}

ProbeGrid::ProbeGrid(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, int most,
                     const TransportFocus& focus, const std::atomic<bool>* stop)
{
    const osg::BoundingBoxf box = boundOf(scene);
    levels.emplace_back();
    levels.back().planes = planesFor(scene, box, most);
    double side = 2.0 * focus.radius;
    for (int i = 0; focus.radius > 0.0 && i < limits::PROBE_LATTICES; ++i, side /= finer)
        levels.push_back(latticeAbout(focus.center, side, box, most));
    for (const Level& level : levels) addLevel(scene, bvh, nearest, level, stop);
}

double ProbeGrid::openShare() const
{
    const Planes& planes = levels.front().planes;
    const size_t count = planes[0].size() * planes[1].size() * planes[2].size(), ofProbe = directions().size();
    std::vector<double> shares(count, 0.0);
    for (size_t i = 0; i < std::min(count * ofProbe, links.size()); ++i)
        if (links[i][0] == SKY) shares[i / ofProbe] += double(directions()[i % ofProbe].share);
    const auto middle = shares.begin() + std::ptrdiff_t(closedPart * double(count));
    std::nth_element(shares.begin(), middle, shares.end());
    return *middle;
}

void ProbeGrid::addLevel(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, const Level& level,
                         const std::atomic<bool>* stop)
{
    const size_t first = probes();
    const Planes& planes = level.planes;
    std::array<int, 3> at{};
    for (at[2] = 0; at[2] < int(planes[2].size()); ++at[2])
        for (at[1] = 0; at[1] < int(planes[1].size()); ++at[1])
            for (at[0] = 0; at[0] < int(planes[0].size()); ++at[0]) {
                if (stop && *stop) return;
                Place place{osg::Vec3f(planes[0][size_t(at[0])], planes[1][size_t(at[1])], planes[2][size_t(at[2])]), 1.0f, true};
                const Spacing spacing = spacingAt(planes, at);
                const std::vector<Seen> seen = settle(scene, bvh, place, spacing.least);
                place.weight = weightOf(seen, std::cbrt(spacing.widest.x() * spacing.widest.y() * spacing.widest.z()));
                places.push_back(place);
                addLinks(scene, bvh, nearest, place, seen);
                addDepths(seen, spacing.widest.length());
            }
    replaceThoseOff(first);
}

// Where a wall is thicker than a cell, all eight probes about it lie within. first: of the last level's.
void ProbeGrid::replaceThoseOff(size_t first)
{
    std::vector<size_t> on;
    for (size_t i = first; i < probes(); ++i)
        if (places[i].on) on.push_back(i);
    const auto copy = [](auto& values, size_t count, size_t from, size_t to) {
        std::copy_n(values.begin() + std::ptrdiff_t(from * count), count, values.begin() + std::ptrdiff_t(to * count));
    };
    for (size_t i = first; i < probes() && !on.empty(); ++i) {
        if (places[i].on) continue;
        const osg::Vec3f place = places[i].position;
        const size_t nearest = *std::min_element(on.begin(), on.end(), [&](size_t a, size_t b) {
            return (places[a].position - place).length2() < (places[b].position - place).length2();
        });
        places[i].position = places[nearest].position;
        places[i].weight = places[nearest].weight;
        copy(links, directions().size(), nearest, i);
        copy(depths, size_t(depthSide) * depthSide, nearest, i);
    }
}

// Far away, a texel of directions is wider than what a point stands for. Without further rays, a small bright thing fills either
// all of the texel or none.
void ProbeGrid::addLinks(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, const Place& place,
                         const std::vector<Seen>& seen)
{
    const float far = nearest.spacing() * 0.5f * float(limits::PROBE_FACE_SIDE);
    const auto linkOf = [&](const Seen& s, const osg::Vec3f& to) {
        return s.triangle < 0 ? s.triangle : int(nearest.find(place.position + to * s.distance, unsigned(s.triangle), s.back));
    };
    for (size_t k = 0; k < seen.size(); ++k) {
        const Direction& d = directions()[k];
        Links all;
        all.fill(linkOf(seen[k], d.to));
        for (size_t i = 0; i < d.others.size() && seen[k].distance > far; ++i)
            all[i + 1] = linkOf(look(scene, bvh, place.position, d.others[i]), d.others[i]);
        links.push_back(all);
    }
}

ProbeGrid::Seen ProbeGrid::look(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from, const osg::Vec3f& to)
{
    const std::optional<CasterBvh::Hit> hit = stoppedRay(scene, bvh, from, to);
    if (!hit) return {1e30f, SKY, false};
    if (hit->back && scene.surfaces[scene.surfaceOf[hit->triangle]].closed) return {hit->distance, BACK, true};
    return {hit->distance, int(hit->triangle), hit->back};
}

std::vector<ProbeGrid::Seen> ProbeGrid::lookAround(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from)
{
    std::vector<Seen> seen;
    for (const Direction& d : directions()) seen.push_back(look(scene, bvh, from, d.to));
    return seen;
}

// Follows from the mean distance that the probe sees, in cells. Of two opposite directions the farther one counts: in a gap both
// are near, beside a wall or in a corner one is far.
float ProbeGrid::weightOf(const std::vector<Seen>& seen, float cell) const
{
    static const std::vector<size_t> opposites = makeOpposites();
    float mean = 0.0f;
    for (size_t k = 0; k < seen.size(); ++k) {
        const float farther = std::max(seen[k].distance, seen[opposites[k]].distance);
        mean += directions()[k].share * std::min(1.0f, farther / cell);
    }
    return std::clamp((mean - 0.5f) / 0.4f, 0.03f, 1.0f);
}

// A probe within a body, which sees its inside over a quarter of all directions, moves out through the nearest side if that is
// not far; one close to a surface moves away from it [indirect.md 3].
std::vector<ProbeGrid::Seen> ProbeGrid::settle(const TracedScene& scene, const CasterBvh& bvh, Place& place, float cell) const
{
    const int tries = 4;
    for (int i = 1;; ++i) {
        std::vector<Seen> seen = lookAround(scene, bvh, place.position);
        float inside = 0.0f;
        size_t nearestBack = seen.size(), nearestFront = seen.size();
        for (size_t k = 0; k < seen.size(); ++k) {
            if (seen[k].triangle == SKY) continue;
            size_t& nearest = seen[k].triangle == BACK ? nearestBack : nearestFront;
            if (nearest == seen.size() || seen[k].distance < seen[nearest].distance) nearest = k;
            if (seen[k].triangle == BACK) inside += directions()[k].share;
        }
        place.on = inside <= 0.25f;
        if (i == tries) return seen;
        if (!place.on && seen[nearestBack].distance < 0.7f * cell)
            place.position += directions()[nearestBack].to * (seen[nearestBack].distance + 0.1f * cell);
        else if (place.on && nearestFront < seen.size() && seen[nearestFront].distance < 0.1f * cell)
            place.position -= directions()[nearestFront].to * (0.15f * cell - seen[nearestFront].distance);
        else
            return seen;
    }
}

void ProbeGrid::addDepths(const std::vector<Seen>& seen, float widest)
{
    static const std::vector<DepthTexel> texels = makeDepthTexels();
    const float most = 1.5f * widest;  // no pixel within the grid asks a probe from farther away
    for (const DepthTexel& texel : texels) {
        double weights = 0.0, sum = 0.0, squares = 0.0;
        for (const auto& [ray, weight] : texel.rays) {
            // Behind a side that nobody sees nothing is near.
            const double distance = double(std::min(seen[ray].distance * (seen[ray].triangle == BACK ? 0.2f : 1.0f), most));
            weights += double(weight);
            sum += double(weight) * distance;
            squares += double(weight) * distance * distance;
        }
        depths.push_back({float(sum / weights), float(squares / weights)});
    }
}

}  // namespace osgEnvLight
