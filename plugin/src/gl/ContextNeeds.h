/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/State>

#include <string>

namespace osgEnvLight
{

/** What the current context lacks of the passes' needs: OpenGL 3.3, GLSL 3.30, the compatibility profile. Empty if it lacks
 * nothing. Asks OpenGL. */
std::string unmetNeeds(const osg::State& state);

}  // namespace osgEnvLight
