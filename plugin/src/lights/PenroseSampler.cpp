// SPDX-License-Identifier: MIT
#include "lights/PenroseSampler.h"

#include "lights/PenroseTiling.h"

#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

ImportanceGrid fluxOf(const LightTexels& texels)
{
    std::vector<double> values(texels.size());
    for (size_t i = 0; i < values.size(); ++i) values[i] = texels.deciding(i);
    return ImportanceGrid(texels.width(), texels.height(), values);
}

// Radiance^(3/4) * solid angle.
ImportanceGrid importanceOf(const LightTexels& texels)
{
    std::vector<double> values(texels.size());
    for (size_t i = 0; i < values.size(); ++i) {
        const double root = std::sqrt(texels.deciding(i) / texels.solidAngle(i));
        values[i] = root * std::sqrt(root) * texels.solidAngle(i);
    }
    return ImportanceGrid(texels.width(), texels.height(), values);
}

osg::Vec3d directionOf(const PenrosePoint& point, const PenroseTable& table)
{
    const osg::Vec2d p = correctedPosition(point, table);
    const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2(0.5 * p.x(), p.y()));
    return osg::Vec3d(d.x, d.y, d.z);
}

}  // namespace

LightList PenroseSampler::equalShares(const LightTexels& texels, unsigned count, const PenroseTable& table)
{
    double whole = 0.0;
    for (size_t i = 0; i < texels.size(); ++i) whole += texels.deciding(i);
    PenroseRule rule;
    rule.onePerCell = false;
    const std::vector<PenrosePoint> points = choosePenrosePoints(fluxOf(texels), count, rule);
    LightList lights;
    lights.reserve(points.size());
    for (const PenrosePoint& p : points) {
        const double share = whole / double(points.size());
        lights.push_back({directionOf(p, table), texels.light(p.cell).rgb * (share / texels.deciding(p.cell))});
    }
    return lights;
}

LightList PenroseSampler::nearestFlux(const LightTexels& texels, unsigned count, const PenroseTable& table)
{
    if (texels.lit() <= count) return texels.lights();
    const std::vector<PenrosePoint> points = choosePenrosePoints(importanceOf(texels), count, PenroseRule());
    std::vector<osg::Vec3d> directions;
    directions.reserve(points.size());
    for (const PenrosePoint& p : points) directions.push_back(directionOf(p, table));
    const std::vector<unsigned char> all(texels.size(), 0);
    std::vector<unsigned> owner(texels.size(), 0);
    findNearest(texels, {all, 0}, directions, 0, owner);
    // So that none is dark: its own texel may lie nearer to a light beside it.
    for (size_t k = 0; k < points.size(); ++k) owner[points[k].cell] = unsigned(k);
    return gatherLights(texels, owner, directions);
}

LightList PenroseSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    return nearestFlux(LightTexels(map, 512, options.floor), count, penroseTable);
}

}  // namespace osgEnvLight
