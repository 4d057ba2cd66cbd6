/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/StaticCasters.h"

namespace osgEnvLight
{

/** What stands still of a scene, for rays on the CPU: triangles about an origin, and what each is made of. */
struct TracedScene {
    /** One for all triangles of a drawable. */
    struct Surface {
        bool closed = false;   // a body: nobody sees its triangles from behind
        float opacity = 1.0f;  // share of the rays that it stops
    };

    std::vector<osg::Vec3f> positions;
    std::vector<std::array<unsigned, 3>> triangles;
    std::vector<unsigned> surfaceOf;           // of each triangle
    std::vector<CasterMesh::Normals> normals;  // of each; empty: all are flat
    std::vector<Surface> surfaces;

    const osg::Vec3f& corner(size_t triangle, int k) const { return positions[triangles[triangle][size_t(k)]]; }
    /** Twice its area long; 0 for a triangle that is none. */
    osg::Vec3f normal(size_t triangle) const
    {
        const osg::Vec3f& a = corner(triangle, 0);
        return (corner(triangle, 1) - a) ^ (corner(triangle, 2) - a);
    }
    /** Of one of its sides, times the share of the rays that it stops. */
    double area(size_t triangle) const
    {
        return 0.5 * double(normal(triangle).length()) * double(surfaces[surfaceOf[triangle]].opacity);
    }
};

/** All parts as one; finds out which are closed. */
OSGENVLIGHT_EXPORT TracedScene tracedScene(const StaticCasters::Parts& parts);

}  // namespace osgEnvLight
