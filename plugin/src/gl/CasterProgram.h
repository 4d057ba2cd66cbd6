/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Program>

#include <string>

namespace osgEnvLight
{

/** What a pass draws surfaces with that this program of SurfaceProgram::create() draws: pass/NAME.vert and pass/NAME.frag.
 * "caster" draws their shadow. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Program> passProgram(const osg::Program& moving, const std::string& pass);

/** The shader reads a uniform that osgViewer changes in every frame. */
OSGENVLIGHT_EXPORT bool followsTime(const osg::Shader& shader);

}  // namespace osgEnvLight
