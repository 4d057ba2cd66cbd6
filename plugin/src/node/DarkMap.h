/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"

namespace osgEnvLight
{

/** Under a black map, or none of its light, lamps still light surfaces that light each other. How much of its surroundings
 * these are to a pixel, O says by lights that stand for all directions alike. Of these a surface gets nothing.
 * @param textures  made at the first call */
void darken(FrameContext& context, osg::ref_ptr<MapTextures>& textures);

}  // namespace osgEnvLight
