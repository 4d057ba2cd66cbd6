/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>
#include "environment/MomentTable.h"

namespace osgEnvLight
{

/** A rectangle of a MomentTable: columns u0..u1, rows v0..v1 from the top. */
struct LightRegion {
    double u0, v0, u1, v1;
    Moments light;     // of the map
    Moments deciding;  // with the floor
    double cost = 0.0;
    unsigned index = 0;  // by age; ties go to the older
    unsigned owner = 0;  // index of the start region that it was cut from
};

/** How regions are divided until there are enough. */
struct RegionRule {
    /** The largest flux * spread^exponent is divided next: 0 median cut, .5 light density L^.8. */
    double exponent = 0.5;
    /** Where the sides are alike, try both and keep the smaller error; else always across the longer. */
    bool bestAxis = true;
    /** Borders between texels only, so that a texel is never divided. */
    bool wholeTexels = false;
};

/** The whole table. */
OSGENVLIGHT_EXPORT LightRegion wholeRegion(const MomentTable& table);

/** Divide regions at half their flux until there are count of them, or fewer where whole texels run out; regions without
 * flux are dropped. In an order that is a function of the input only.*/
OSGENVLIGHT_EXPORT std::vector<LightRegion> divideRegions(const MomentTable& table, std::vector<LightRegion> regions,
                                                          size_t count, const RegionRule& rule);

/** Sine of the mean angle from the centroid: sqrt(1 - |mean direction|^2). */
OSGENVLIGHT_EXPORT double spread(const Moments& m);

/** A light of the region's flux at its flux centroid. */
OSGENVLIGHT_EXPORT DirectionalLight regionLight(const LightRegion& region, const MomentTable& table);

/** The whole table divided into count regions, each a light. */
OSGENVLIGHT_EXPORT LightList regionLights(const MomentTable& table, size_t count, const RegionRule& rule);

}  // namespace osgEnvLight
