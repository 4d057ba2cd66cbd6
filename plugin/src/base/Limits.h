/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

namespace osgEnvLight
{

/** The counts and marks of shaders/lib/limits.glsl. */
namespace limits
{
#include "lib/limits.glsl"
}

}  // namespace osgEnvLight
