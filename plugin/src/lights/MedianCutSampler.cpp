// SPDX-License-Identifier: MIT
#include "lights/MedianCutSampler.h"

#include "lights/LightRegions.h"

namespace osgEnvLight
{

LightList MedianCutSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const MomentTable table(map, 1024, options.floor);
    RegionRule rule;
    rule.exponent = 0.0;
    rule.bestAxis = false;
    rule.wholeTexels = true;
    return regionLights(table, count, rule);
}

}  // namespace osgEnvLight
