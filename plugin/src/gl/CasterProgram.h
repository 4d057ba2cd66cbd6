/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Program>

namespace osgEnvLight
{

/** What draws the shadow of surfaces that this program of SurfaceProgram::create() draws. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Program> casterProgram(const osg::Program& moving);

/** The shader reads a uniform that osgViewer changes in every frame. */
OSGENVLIGHT_EXPORT bool followsTime(const osg::Shader& shader);

}  // namespace osgEnvLight
