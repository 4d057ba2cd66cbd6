/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/CasterBvh.h"

namespace osgEnvLight
{

/** The nearest surface on a ray that stops it. Of the rays to a surface with holes, some go through.
 * @param bvh     of the scene
 * @param within  what lies farther away is not met, in lengths of the direction */
std::optional<CasterBvh::Hit> stoppedRay(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from,
                                         const osg::Vec3f& to, float within = std::numeric_limits<float>::max());

}  // namespace osgEnvLight
