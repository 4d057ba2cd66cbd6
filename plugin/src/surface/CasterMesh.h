/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterCollector.h"

#include <array>
#include <optional>

namespace osgEnvLight
{

struct CasterMesh {
    std::vector<osg::Vec3f> positions;  // about an origin
    std::vector<std::array<unsigned, 3>> triangles;
    std::optional<bool> closed;  // whether the caster's surface was, where merging vertices hides it
};

/** A caster's triangles about origin; those with a vertex that is not finite are left out. */
OSGENVLIGHT_EXPORT CasterMesh meshOf(const Caster& caster, const osg::Vec3d& origin);

/** The same, coarser. Where they are finer than cell [world units], their vertices are merged within cells of
 * that size, a half or a quarter of it [Rossignac and Borrel 1993], each at the mean of those it stands for: flat and coarse
 * surfaces stay exact. A caster that would lose a tenth of its area, as leaves and rods do, stays as it is. */
OSGENVLIGHT_EXPORT CasterMesh coarseMesh(const Caster& caster, const osg::Vec3d& origin, double cell);

/** For each vertex the number of its place: those that differ by rounding have the same. Corners with normals of their own are
 * several vertices at one place. */
OSGENVLIGHT_EXPORT std::vector<unsigned> placesOf(const CasterMesh& mesh);

/** Whether each edge is one of two triangles, which run along it in opposite directions, and the triangles face outwards. */
OSGENVLIGHT_EXPORT bool isClosed(const CasterMesh& mesh);

}  // namespace osgEnvLight
