// SPDX-License-Identifier: MIT
#include <osgEnvLight/SplitSampler>

#include <osgEnvLight/LightRegions>

namespace osgEnvLight
{

LightList SplitSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const MomentTable table(map, MomentTable::columnsFor(count), options.floor);
    LightList lights;
    lights.reserve(count);
    for (const LightRegion& r : divideRegions(table, {wholeRegion(table)}, count, RegionRule()))
        lights.push_back(regionLight(r, table));
    return lights;
}

}  // namespace osgEnvLight
