/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"

#include <osg/Vec3d>

#include <array>
#include <vector>

namespace osgEnvLight
{

/** A triangle that has an area, by its corners' places. */
struct MeshTriangle {
    std::array<unsigned, 3> corners;
    osg::Vec3d center;
    osg::Vec3d normal;  // unit
    double area;
};

/** A mesh as its connected bodies. */
struct MeshBodies {
    struct Body {
        std::vector<MeshTriangle> triangles;
        bool open;  // it has an edge of which the triangle on the other side is missing
    };
    std::vector<osg::Vec3d> places;
    std::vector<Body> bodies;
};

/** Those of the mesh. Closed ones face outwards: one that is inside out is turned over. */
MeshBodies bodiesOf(const CasterMesh& mesh);

/** The flat parts of a body: neighbouring triangles whose normals differ by a degree at most. Parts with large triangles come
 * first.
 */
std::vector<std::vector<MeshTriangle>> flatPartsOf(const MeshBodies::Body& body, const std::vector<osg::Vec3d>& places);

/** Places around a flat part, as its triangles turn, without those on a straight line between others; empty if it has holes or
 * touches itself. */
std::vector<osg::Vec3d> outlineOf(const std::vector<MeshTriangle>& part, const std::vector<osg::Vec3d>& places);

}  // namespace osgEnvLight
