// SPDX-License-Identifier: MIT
#include "gl/FullScreenTriangle.h"

namespace osgEnvLight
{

void setFullScreenTriangle(osg::Geometry& geometry, osg::Vec3Array* vertices)
{
    geometry.setVertexArray(vertices);
    geometry.addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
    geometry.setCullingActive(false);
}

osg::ref_ptr<osg::Vec3Array> fullScreenVertices()
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back(osg::Vec3(-1, -1, 0));
    vertices->push_back(osg::Vec3(3, -1, 0));
    vertices->push_back(osg::Vec3(-1, 3, 0));
    return vertices;
}

osg::ref_ptr<osg::Geometry> makeFullScreenTriangle(osg::Vec3Array* vertices)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    setFullScreenTriangle(*geometry, vertices);
    return geometry;
}

}  // namespace osgEnvLight
