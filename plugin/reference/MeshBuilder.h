// SPDX-License-Identifier: MIT
// An osg::Geometry as a TriangleMesh.
#pragma once

#include <reference/TriangleScene>

#include <osg/Geometry>
#include <osg/Matrixd>

namespace osgEnvLight
{

/** Appends the geometry's triangles, transformed, positions relative to origin.
 * @param counts  its degenerate triangles are added to
 * @return        false if there is nothing but points and lines */
bool appendTriangles(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel, const osg::Matrixd& textureMatrix,
                     const glm::dvec3& origin, TriangleMesh& mesh, TriangleScene& counts);

}  // namespace osgEnvLight
