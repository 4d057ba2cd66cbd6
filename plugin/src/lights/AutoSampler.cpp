// SPDX-License-Identifier: MIT
#include "lights/AutoSampler.h"

#include "lights/LightClusters.h"

namespace osgEnvLight
{

LightList AutoSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const MomentTable table(map, MomentTable::columnsFor(count), options.floor);
    if (count > largestRefined) return regionLights(table, count, RegionRule());
    LightClusters clusters(table, count);
    clusters.refine(6);
    clusters.fillEmpty();
    return clusters.lights();
}

}  // namespace osgEnvLight
