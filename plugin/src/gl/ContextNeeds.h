/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/State>

#include <string>

namespace osgEnvLight
{

/** What the context is that is current, and what all passes need, where it is less than that: OpenGL 3.3, its shading language,
 * the compatibility profile. Empty: it is enough. Asks OpenGL. */
std::string unmetNeeds(const osg::State& state);

}  // namespace osgEnvLight
