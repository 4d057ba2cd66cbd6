// SPDX-License-Identifier: MIT
#include "lights/InverseCdfSampler.h"

#include "lights/MapSequence.h"

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

}  // namespace

LightList InverseCdfSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    MapDistribution distribution(map, options.floor * map.meanOfChannels());
    const osg::Vec2d shift = shiftOf(options.seed);
    LightList lights;
    lights.reserve(count);
    // The points come in the order of their rows, which MapDistribution likes.
    for (unsigned i = 0; i < count; ++i) {
        lights.push_back(distribution.at(osg::Vec2d((i + shift[0]) / count, glsl::fract(shift[1] + i * goldenRatio))));
        lights.back().flux /= count;
    }
    return lights;
}

}  // namespace osgEnvLight
