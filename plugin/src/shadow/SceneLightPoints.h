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
std::vector<EmitterPoint> sceneLightPoints(const SceneLightList& lights, const osg::Matrixd& worldFromEye,
                                           const osg::BoundingBoxd& casters, SceneLightFaces& faces);

}  // namespace osgEnvLight
