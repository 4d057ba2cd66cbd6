/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/EmitterPoints.h"
#include "surface/SceneLights.h"

#include <osg/BoundingBox>

namespace osgEnvLight
{

/** Where the shadow maps of the application's lights stand. A spot of up to 63 degrees has one that shows its cone; other spots
 * and point lights have six, the faces of a cube along the world's axes: +x, -x, +y, -y, +z, -z; a directional light has one,
 * from a hundred times as far off as the casters are wide. The lights of the view have none: what they light is what it sees.
 * @param casters  box of what casts shadows, in the world
 * @param faces    receives which maps are whose */
OSGENVLIGHT_EXPORT std::vector<EmitterPoint> sceneLightPoints(const SceneLightList& lights, const osg::Matrixd& worldFromEye,
                                                              const osg::BoundingBoxd& casters, SceneLightFaces& faces);

/** Whether these differ from former ones by no more than what lights are rounded to on their way to a view and back: then only
 * the view has moved. */
OSGENVLIGHT_EXPORT bool areRounded(const std::vector<EmitterPoint>& points, const std::vector<EmitterPoint>& former,
                                   const osg::BoundingBoxd& casters, const osg::Vec3d& eye);

}  // namespace osgEnvLight
