/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Emitter.h"

#include <vector>

namespace osgEnvLight
{

/** Area lights as a tree of clusters: neighbours that face alike are together [Walter et al. 2005, "Lightcuts: A Scalable
 * Approach to Illumination"]. A light that is lit on both sides has a leaf for each. */
struct EmitterCluster {
    osg::Vec3d place;     // mean of their centers by power, in the world
    osg::Vec3d reach;     // half of the sides of a box about the place that holds them
    osg::Vec3d axis;      // unit: mean of the normals by power; of spheres, any
    double spread = 0.0;  // most that a normal differs from it, as vectors; 2 where some are spheres
    osg::Vec3d power;     // radiance times area, as if all faced along the axis; of spheres, radiance times a quarter of the area
    bool isRound = false;  // all are spheres
    int light = -1;        // number in the list; -1: it has children
    bool back = false;     // of the light's back
    unsigned next = 0;     // the cluster after it and what is in it; after itself come its children
};

/** Depth first; empty where no light is lit. */
OSGENVLIGHT_EXPORT std::vector<EmitterCluster> emitterTree(const std::vector<Emitter>& lights);

}  // namespace osgEnvLight
