/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/State>

#include <string>

namespace osgEnvLight
{

/** That the current context has less than all passes need, in words: OpenGL 3.3, GLSL 3.30, the compatibility profile. Empty: it
 * has all that. Asks OpenGL. */
std::string unmetNeeds(const osg::State& state);

}  // namespace osgEnvLight
