// SPDX-License-Identifier: MIT
#include <osgEnvLight/InverseCdfSampler>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double goldenRatio = 0.61803398874989484820;

// Two numbers in [0, 1) from the seed [splitmix64: Steele et al. 2014].
osg::Vec2d shiftOf(unsigned seed)
{
    osg::Vec2d shift;
    uint64_t state = seed;
    for (int i = 0; i < 2; ++i) {
        uint64_t z = (state += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        shift[i] = double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    return shift;
}

double brightness(const float* t)
{
    return double(t[0]) + double(t[1]) + double(t[2]);
}

// What decides on texel x: what it emits, with the uniform floor.
double deciding(const RadianceMap& map, int x, int y, double floor)
{
    return brightness(map.texel(x, y)) + 3.0 * floor;
}

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

LightList InverseCdfSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const double floor = options.floor * map.meanOfChannels();
    const glsl::vec2 size(map.width, map.height);
    std::vector<double> rows(size_t(map.height) + 1, 0.0);
    for (int y = 0; y < map.height; ++y) {
        double sum = 0.0;
        for (int x = 0; x < map.width; ++x) sum += deciding(map, x, y, floor);
        rows[size_t(y) + 1] = rows[size_t(y)] + sum * glsl::latlongTexelSolidAngle(y, size);
    }
    const osg::Vec2d shift = shiftOf(options.seed);
    LightList lights;
    lights.reserve(count);
    // The points come in the order of their rows: only the sums of one row are kept.
    std::vector<double> columns(size_t(map.width) + 1, 0.0);
    size_t current = size_t(map.height);
    for (unsigned i = 0; i < count; ++i) {
        const Place row = find(rows, (i + shift[0]) / count * rows.back());
        if (row.index != current) {
            current = row.index;
            for (int x = 0; x < map.width; ++x)
                columns[size_t(x) + 1] = columns[size_t(x)] + deciding(map, x, int(current), floor);
        }
        const Place column = find(columns, glsl::fract(shift[1] + i * goldenRatio) * columns.back());
        const double z0 = std::cos(glsl::PI * double(row.index) / map.height);
        const double z1 = std::cos(glsl::PI * double(row.index + 1) / map.height);
        const double z = z0 + (z1 - z0) * row.share;
        const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        const double phi = glsl::TWO_PI * (0.5 - (double(column.index) + column.share) / map.width);
        const float* t = map.texel(int(column.index), int(row.index));
        const double weight = rows.back() / (count * deciding(map, int(column.index), int(row.index), floor));
        lights.push_back({osg::Vec3d(r * std::cos(phi), r * std::sin(phi), z), osg::Vec3d(t[0], t[1], t[2]) * weight});
    }
    return lights;
}

}  // namespace osgEnvLight
