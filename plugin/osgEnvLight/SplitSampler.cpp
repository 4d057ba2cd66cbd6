// SPDX-License-Identifier: MIT
#include <osgEnvLight/SplitSampler>

#include <osgEnvLight/LightRegions>

namespace osgEnvLight
{

LightList SplitSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    return regionLights(MomentTable(map, MomentTable::columnsFor(count), options.floor), count, RegionRule());
}

}  // namespace osgEnvLight
