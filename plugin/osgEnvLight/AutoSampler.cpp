// SPDX-License-Identifier: MIT
#include <osgEnvLight/AutoSampler>

#include <osgEnvLight/LightClusters>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

LightList AutoSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const MomentTable table(map, int(std::max(512.0, 32.0 * std::sqrt(double(count)))), options.floor);
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
