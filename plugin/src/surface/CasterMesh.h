/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"

#include <array>
#include <optional>

namespace osgEnvLight
{

struct CasterMesh {
    using Triangle = std::array<unsigned, 3>;
    /** Of a triangle's corners, packDirection() of each; negative: the triangle is flat. */
    using Normals = std::array<float, 3>;
    static constexpr Normals flat = {-1.0f, -1.0f, -1.0f};

    std::vector<osg::Vec3f> positions;  // about an origin
    std::vector<Triangle> triangles;
    std::vector<Normals> normals;  // of each triangle; empty: all are flat
    std::optional<bool> closed;    // whether the caster's surface was, where merging vertices hides it
};

/** A caster's triangles about origin; those with a vertex that is not finite are left out. */
OSGENVLIGHT_EXPORT CasterMesh meshOf(const Caster& caster, const osg::Vec3d& origin);

/** For each vertex the number of its place: those that differ by rounding have the same. Corners with normals of their own are
 * several vertices at one place. */
OSGENVLIGHT_EXPORT std::vector<unsigned> placesOf(const CasterMesh& mesh);

/** Whether each edge is one of two triangles, which run along it in opposite directions, and the triangles face outwards. */
OSGENVLIGHT_EXPORT bool isClosed(const CasterMesh& mesh);
/** The same by its triangles alone. at: the numbers of its vertices' places. */
bool isClosed(const CasterMesh& mesh, const std::vector<unsigned>& at);

}  // namespace osgEnvLight
