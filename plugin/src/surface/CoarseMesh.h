/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"

namespace osgEnvLight
{

/** A caster's triangles about origin, coarser where they are finer than cell [world units]. The vertices within a cell of that
 * size, or of a half, a quarter and so on of it, are merged [Rossignac and Borrel 1993] where the planes of their triangles meet
 * [Lindstrom 2000]: flat and coarse surfaces stay exact, and small round ones keep their size. The largest cells count
 * that leave a caster its area within a tenth; one that gets no fewer triangles by them, as leaves, stays as it is. */
OSGENVLIGHT_EXPORT CasterMesh coarseMesh(const Caster& caster, const osg::Vec3d& origin, double cell);

}  // namespace osgEnvLight
