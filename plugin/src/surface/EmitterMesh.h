/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Emitter.h"

#include <osg/Geometry>

namespace osgEnvLight
{

/** An emitter's surface as triangles with normals, counter-clockwise seen from the lit side. */
osg::ref_ptr<osg::Geometry> makeEmitterMesh(const Emitter& emitter);

/** The same seen from the other side. */
osg::ref_ptr<osg::Geometry> makeEmitterBack(const Emitter& emitter);

}  // namespace osgEnvLight
