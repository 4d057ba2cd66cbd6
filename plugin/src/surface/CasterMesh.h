/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterCollector.h"

#include <array>

namespace osgEnvLight
{

struct CasterMesh {
    std::vector<osg::Vec3f> positions;  // about an origin
    std::vector<std::array<unsigned, 3>> triangles;
};

/** A caster's triangles about origin. Where they are finer than cell [world units], their vertices are merged within cells of
 * that size, a half or a quarter of it [Rossignac and Borrel 1993], each at the mean of those it stands for: flat and coarse
 * surfaces stay exact. A caster that would lose a tenth of its area, as leaves and rods do, stays as it is. */
OSGENVLIGHT_EXPORT CasterMesh coarseMesh(const Caster& caster, const osg::Vec3d& origin, double cell);

}  // namespace osgEnvLight
