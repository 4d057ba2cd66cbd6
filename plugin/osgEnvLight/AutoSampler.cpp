// SPDX-License-Identifier: MIT
#include <osgEnvLight/AutoSampler>

#include <osgEnvLight/LightClusters>

namespace osgEnvLight
{

LightList AutoSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const MomentTable table(map, MomentTable::columnsFor(count), options.floor);
    if (count > largestRefined) {
        LightList lights;
        for (const LightRegion& r : divideRegions(table, {wholeRegion(table)}, count, RegionRule()))
            lights.push_back(regionLight(r, table));
        return lights;
    }
    LightClusters clusters(table, count);
    clusters.refine(6);
    clusters.fillEmpty();
    return clusters.lights();
}

}  // namespace osgEnvLight
