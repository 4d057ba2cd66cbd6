// SPDX-License-Identifier: MIT
#include "shadow/EmitterPoints.h"

#include "base/R2Points.h"

#include <osg/BoundingBox>
#include <osg/Math>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double golden = 0.61803398874989485;
// Off the surface, in shares of its width: what is drawn of the light then lies behind the point's map.
const double lift = 1e-4;

// With fewer points on a sphere there are places that none of them faces.
const unsigned leastRound = 6;

// A side of a light that sends light.
struct Side {
    const Emitter* light;
    double turned;  // -1: the back
    double flux;
    unsigned points = 0;
};

std::vector<Side> litSides(const std::vector<Emitter>& lights)
{
    std::vector<Side> sides;
    for (const Emitter& light : lights) {
        const double flux = light.flux() / (light.twoSided ? 2.0 : 1.0);
        if (!(flux > 0.0)) continue;
        sides.push_back({&light, 1.0, flux});
        if (light.twoSided) sides.push_back({&light, -1.0, flux});
    }
    return sides;
}

// A point of the polygon at (a, b) of the unit square, by the areas of its triangles.
osg::Vec3d onPolygon(const Emitter& light, double a, double b)
{
    double left = a * light.area;
    const size_t count = light.triangles.size() / 3;
    for (size_t i = 0; i < count; ++i) {
        const osg::Vec3d& p = light.vertices[light.triangles[3 * i]];
        const osg::Vec3d q = light.vertices[light.triangles[3 * i + 1]] - p, r = light.vertices[light.triangles[3 * i + 2]] - p;
        const double area = 0.5 * (q ^ r).length();
        if (left > area && i + 1 < count) {
            left -= area;
            continue;
        }
        const double s = std::sqrt(std::clamp(left / area, 0.0, 1.0));
        return p + q * (s * (1.0 - b)) + r * (s * b);
    }
    return osg::Vec3d();
}

EmitterPoint pointAt(const Side& side, double a, double b)
{
    const Emitter& light = *side.light;
    EmitterPoint point;
    point.normal = light.normal * side.turned;
    const double angle = 2.0 * osg::PI * b;
    osg::Vec3d offset;
    switch (light.shape) {
        case AreaLight::RECTANGLE:
            offset = light.u * (2.0 * a - 1.0) + light.v * (2.0 * b - 1.0);
            break;
        case AreaLight::DISC:
            offset = (light.u * std::cos(angle) + light.v * std::sin(angle)) * std::sqrt(a);
            break;
        case AreaLight::SPHERE: {
            const double z = 1.0 - 2.0 * a, r = std::sqrt(std::max(1.0 - z * z, 0.0));
            point.normal = osg::Vec3d(r * std::cos(angle), r * std::sin(angle), z);
            offset = point.normal * light.radius();
            break;
        }
        case AreaLight::POLYGON:
            offset = onPolygon(light, a, b);
            break;
    }
    point.position = light.center + offset + point.normal * (lift * std::sqrt(light.area));
    return point;
}

// What the picture shows at (a, b) of the rectangle and about it, over as much as one of `count` even parts.
osg::Vec3d shownAt(const Emitter& light, double a, double b, unsigned count)
{
    const double half = 0.5 * std::sqrt(light.area / count);
    const osg::Vec2d center(a, light.pictureTurned ? 1.0 - b : b);
    const osg::Vec3d shown = light.picture->mean(center, osg::Vec2d(half / light.u.length(), half / light.v.length()) * 0.5);
    return osg::componentMultiply(shown, light.tint);
}

// Together they send what the light does.
void evenOut(std::vector<EmitterPoint>::iterator first, std::vector<EmitterPoint>::iterator last)
{
    osg::Vec3d sum, even;
    for (auto p = first; p != last; ++p) {
        sum += p->power;
        even += p->even;
    }
    for (auto p = first; p != last; ++p)
        for (int i = 0; i < 3; ++i) p->power[i] = sum[i] > 0.0 ? p->power[i] * (even[i] / sum[i]) : p->even[i];
}

// The points that each side gets: one, and of the rest by flux, by the largest remainders.
void deal(std::vector<Side>& sides, unsigned count)
{
    double total = 0.0;
    for (const Side& side : sides) total += side.flux;
    const auto rest = double(count - sides.size());
    std::vector<std::pair<double, size_t>> remainders;
    unsigned dealt = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
        const double share = rest * sides[i].flux / total;
        sides[i].points = 1 + unsigned(share);
        dealt += sides[i].points;
        remainders.emplace_back(std::floor(share) - share, i);
    }
    std::sort(remainders.begin(), remainders.end());
    for (unsigned k = 0; dealt < count; ++k, ++dealt) ++sides[remainders[k % remainders.size()].second].points;
}

// Of a set of points: the first lies where it is, the others between its points.
osg::Vec2d shiftOf(unsigned round)
{
    return round == 0 ? osg::Vec2d() : r2Point(round);
}

double wrapped(double x)
{
    return x - std::floor(x);
}

std::vector<EmitterPoint> pointsOf(const std::vector<Side>& sides, const osg::Vec2d& shift)
{
    std::vector<EmitterPoint> points;
    for (const Side& side : sides) {
        for (unsigned k = 0; k < side.points; ++k) {
            const double a = wrapped((k + 0.5 + shift[0]) / side.points), b = wrapped(k * golden + 0.5 + shift[1]);
            EmitterPoint point = pointAt(side, a, b);
            point.area = side.light->area / side.points;
            point.isRound = side.light->shape == AreaLight::SPHERE && side.points >= leastRound;
            point.even = side.light->radiance * point.area;
            point.power = side.light->picture ? shownAt(*side.light, a, b, side.points) * point.area : point.even;
            points.push_back(point);
        }
        if (side.light->picture) evenOut(points.end() - std::ptrdiff_t(side.points), points.end());
    }
    return points;
}

uint64_t mortonCode(const osg::Vec3d& unit)
{
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = uint64_t(std::clamp(unit[axis], 0.0, 1.0) * 1023.0);
        for (int bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1) << (3 * bit + axis);
    }
    return code;
}

// Neighbours side by side.
void sortByPlace(std::vector<Side>& sides)
{
    osg::BoundingBoxd box;
    for (const Side& side : sides) box.expandBy(side.light->center);
    const osg::Vec3d size = box._max - box._min;
    const double longest = std::max({size[0], size[1], size[2], 1e-300});
    std::stable_sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
        return mortonCode((a.light->center - box._min) / longest) < mortonCode((b.light->center - box._min) / longest);
    });
}

std::vector<EmitterPoint> pointsOfMany(std::vector<Side> sides, unsigned count, const osg::Vec2d& shift)
{
    sortByPlace(sides);
    const double total = std::accumulate(sides.begin(), sides.end(), 0.0, [](double sum, const Side& s) { return sum + s.flux; });
    std::vector<EmitterPoint> points;
    double before = 0.0;
    for (const Side& side : sides) {
        before += side.flux;
        // The next of `count` even steps through all flux that end within this side's.
        while (points.size() < count && (double(points.size()) + wrapped(0.5 + shift[0])) / count * total < before) {
            const auto k = double(points.size());
            EmitterPoint point =
                pointAt(side, wrapped(k * golden + 0.5 + shift[0]), wrapped(k * golden * golden + 0.25 + shift[1]));
            point.area = side.light->area * total / (count * side.flux);  // also for neighbours that have none
            point.power = point.even = side.light->radiance * point.area;
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace

std::vector<EmitterPoint> emitterPoints(const std::vector<Emitter>& lights, unsigned count, unsigned round)
{
    const osg::Vec2d shift = shiftOf(round);
    std::vector<Side> sides = litSides(lights);
    std::vector<EmitterPoint> points;
    if (sides.size() > count) {
        points = pointsOfMany(sides, count, shift);
    } else if (!sides.empty()) {
        deal(sides, count);
        points = pointsOf(sides, shift);
    }
    const EmitterPoint dark{osg::Vec3d(), osg::Vec3d(0, 0, 1), osg::Vec3d(), osg::Vec3d(), 1.0};
    points.resize(count, dark);
    for (unsigned i = 0; i < count; ++i) {
        points[i].turn = 2.39996322972865332 * i;  // golden angle: neighbours' texels don't fall in step
        points[i].tangent = glsl::EMITTER_MAP_TANGENT;
    }
    return points;
}

}  // namespace osgEnvLight
