/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/EnvironmentMap>

namespace osgEnvLight
{

/** A map as its dominant lights and what is left: flux(suns) + flux(residual) = flux(map). */
struct SunSplit {
    DominantLights suns;                       // the largest flux first
    osg::ref_ptr<const RadianceMap> residual;  // the map itself when there are none
};

/** How many suns were cut from the map, and their share of its flux. */
struct SunShare {
    unsigned count = 0;
    double share = 0.0;
};

/** Find bright, small sources as connected regions of the map, whatever their number, and cut them out, with a membrane
 * over what is behind each (sampling.md 5). The criterion is relative to the map's own statistics: within 5.3 degrees of
 * radius, at least 2 % of the map's flux, 12 times as bright as its surroundings, filled like a disc. Neither a window, a
 * softbox nor a bright half sky is one.
 * @param maximum the largest are taken
 * @param former  those of the map's last state: one that was there stays until it has less than 1.5 % */
OSGENVLIGHT_EXPORT SunSplit splitSuns(const RadianceMap& map, unsigned maximum, const DominantLights& former = {});

}  // namespace osgEnvLight
