// SPDX-License-Identifier: MIT
#include "shadow/LitSides.h"

#include "base/R2Points.h"

#include <osg/Math>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const double golden = 0.61803398874989485;
// Off the surface, in shares of its width: what is drawn of the light then lies behind the point's map.
const double lift = 1e-4;

// In the same shares: a lamp's post or bracket is farther off.
const double nearestOccluder = 0.2;

// With fewer points on a sphere there are places that none of them faces.
const unsigned leastRound = 6;

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

EmitterPoint pointAt(const LitSide& side, double a, double b)
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

}  // namespace

std::vector<LitSide> litSides(const std::vector<Emitter>& lights)
{
    std::vector<LitSide> sides;
    for (const Emitter& light : lights) {
        const int lit = light.litSides();
        for (int side = 0; side < lit; ++side) sides.push_back({&light, side == 0 ? 1.0 : -1.0, light.flux() / lit});
    }
    return sides;
}

size_t countLitSides(const std::vector<Emitter>& lights)
{
    size_t count = 0;
    for (const Emitter& light : lights) count += size_t(light.litSides());
    return count;
}

EmitterPoint pointOf(const LitSide& side, const SidePart& part, const osg::Vec2d& shift)
{
    const double a = wrapped((part.part + 0.5 + shift[0]) / part.parts), b = wrapped(part.part * golden + 0.5 + shift[1]);
    EmitterPoint point = pointAt(side, a, b);
    point.area = side.light->area / part.parts;
    point.isRound = side.light->shape == AreaLight::SPHERE && part.parts >= leastRound;
    point.nearest = nearestOccluder * std::sqrt(side.light->area);
    point.even = side.light->radiance * point.area;
    point.power = side.light->picture ? shownAt(*side.light, a, b, part.parts) * point.area : point.even;
    return point;
}

}  // namespace osgEnvLight
