// SPDX-License-Identifier: MIT
#include "lights/MapSequence.h"

#include "base/R2Points.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Where `target` falls in the increasing sums (sums[0] = 0): the interval and the share of it; never one without width.
struct Place {
    size_t index;
    double share;
};

Place find(const std::vector<double>& sums, double target)
{
    const auto end = std::upper_bound(sums.begin() + 1, sums.end(), target);
    size_t i = size_t((end == sums.end() ? end - 1 : end) - sums.begin()) - 1;
    while (i > 0 && !(sums[i + 1] > sums[i])) --i;
    const double width = sums[i + 1] - sums[i];
    return {i, width > 0.0 ? std::clamp((target - sums[i]) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

MapDistribution::MapDistribution(const RadianceMap& map, double floor, double exponent)
    : _map(&map), _floor(floor), _exponent(exponent), _rows(size_t(map.height) + 1, 0.0), _columns(size_t(map.width) + 1, 0.0)
{
    const glsl::vec2 size(map.width, map.height);
    for (int y = 0; y < map.height; ++y) {
        double sum = 0.0;
        for (int x = 0; x < map.width; ++x) sum += deciding(x, y);
        _rows[size_t(y) + 1] = _rows[size_t(y)] + sum * glsl::latlongTexelSolidAngle(y, size);
    }
}

double MapDistribution::deciding(int x, int y) const
{
    const float* t = _map->texel(x, y);
    const double radiance = double(t[0]) + double(t[1]) + double(t[2]) + 3.0 * _floor;
    return _exponent == 1.0 ? radiance : std::pow(radiance, _exponent);
}

DirectionalLight MapDistribution::at(const osg::Vec2d& u)
{
    const RadianceMap& map = *_map;
    if (!(_rows.back() > 0.0)) return {osg::Vec3d(0, 0, 1), osg::Vec3d()};
    const Place row = find(_rows, u[0] * _rows.back());
    if (int(row.index) != _row) {
        _row = int(row.index);
        for (int x = 0; x < map.width; ++x) _columns[size_t(x) + 1] = _columns[size_t(x)] + deciding(x, _row);
    }
    const Place column = find(_columns, u[1] * _columns.back());
    const double z0 = std::cos(glsl::PI * double(row.index) / map.height);
    const double z1 = std::cos(glsl::PI * double(row.index + 1) / map.height);
    const double z = z0 + (z1 - z0) * row.share;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = glsl::TWO_PI * (0.5 - (double(column.index) + column.share) / map.width);
    const float* t = map.texel(int(column.index), int(row.index));
    const double weight = _rows.back() / deciding(int(column.index), int(row.index));
    return {osg::Vec3d(r * std::cos(phi), r * std::sin(phi), z), osg::Vec3d(t[0], t[1], t[2]) * weight};
}

LightList MapSequence::next(unsigned count)
{
    LightList lights;
    lights.reserve(count);
    for (unsigned i = 0; i < count; ++i) {
        lights.push_back(_distribution.at(r2Point(_index++)));
        lights.back().flux /= count;
    }
    return lights;
}

}  // namespace osgEnvLight
