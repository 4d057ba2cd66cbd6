/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"

namespace osgEnvLight
{

/** A caster's triangles about origin, coarser where they are finer than cell [world units]. All vertices
 * within a cell of a grid become one [Rossignac and Borrel 1993], which lies where the planes of their triangles meet
 * [Lindstrom 2000]: flat surfaces stay exact, and round ones keep their size. Cells are halved until the area is kept within
 * a tenth. A caster that then has no fewer triangles, as leaves, stays as it is. */
OSGENVLIGHT_EXPORT CasterMesh coarseMesh(const Caster& caster, const osg::Vec3d& origin, double cell);

}  // namespace osgEnvLight
