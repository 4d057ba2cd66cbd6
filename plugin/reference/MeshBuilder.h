// SPDX-License-Identifier: MIT
// An osg::Geometry as a TriangleMesh.
#pragma once

#include <reference/TriangleScene>

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Matrixd>

namespace osgEnvLight
{

/** Expands a box of the world by the geometry's triangles. Unlike Drawable::getBoundingBox it follows no index beyond the vertices
 * and leaves out triangles that are not finite. */
void expandByTriangles(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel, osg::BoundingBoxd& box);

/** Appends the geometry's triangles, transformed, positions relative to origin.
 * @param counts  its degenerate triangles are added to
 * @return        false if there is nothing but points and lines */
bool appendTriangles(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel, const osg::Matrixd& textureMatrix,
                     const glm::dvec3& origin, TriangleMesh& mesh, TriangleScene& counts);

}  // namespace osgEnvLight
