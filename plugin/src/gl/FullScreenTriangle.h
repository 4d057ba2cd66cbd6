/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Geometry>

namespace osgEnvLight
{

/** The corners of one triangle over the viewport, in clip coordinates. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Vec3Array> fullScreenVertices();
/** That triangle. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Geometry> makeFullScreenTriangle(osg::Vec3Array* vertices);

/** Make geometry that triangle. */
void setFullScreenTriangle(osg::Geometry& geometry, osg::Vec3Array* vertices);

}  // namespace osgEnvLight
