/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/State>

#include <string>

namespace osgEnvLight
{

/** Says what the current context has less than the passes need: OpenGL 3.3, GLSL 3.30 and the compatibility profile. Empty if it
 * has all of it. Asks OpenGL. */
std::string unmetNeeds(const osg::State& state);

}  // namespace osgEnvLight
