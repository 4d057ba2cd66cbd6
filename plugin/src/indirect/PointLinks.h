/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/SurfacePoints.h"

#include <atomic>
#include <vector>

namespace osgEnvLight
{

enum PointLink : int { NOTHING = -1, INSIDE_OF_BODY = -2 };

/** What surface points see close by, which probes farther apart than that can't tell them: limits::POINT_LINKS directions of each
 * point, spread by the cosine, and for each the number of the point that stands for the surface met, or a PointLink. Points in a
 * hollow, with surfaces close by in a quarter of the directions, have links to those far away, too.
 * @param bvh      of the scene
 * @param within   surfaces farther away are not close
 * @param stop     set by another thread: the rest is NOTHING */
OSGENVLIGHT_EXPORT std::vector<int> linkPoints(const TracedScene& scene, const CasterBvh& bvh,
                                               const std::vector<SurfacePoint>& points, const NearestPoint& nearest, float within,
                                               const std::atomic<bool>* stop = nullptr);

}  // namespace osgEnvLight
