// SPDX-License-Identifier: MIT
#include "lights/SplitSampler.h"

#include "lights/LightRegions.h"

namespace osgEnvLight
{

LightList SplitSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    return regionLights(MomentTable(map, MomentTable::columnsFor(count), options.floor), count, RegionRule());
}

}  // namespace osgEnvLight
