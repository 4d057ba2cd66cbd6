/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Image>

namespace osgEnvLight
{

/** The map as lobes of GGX reflect it to an eye straight above (lib/prefiltered.glsl).
 * @param pyramid  of makePyramid()
 * @param side     of its level 0
 * @return the same atlas, but each level holds the map filtered by the lobe whose alpha is prefilteredAlpha() */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> prefilterPyramid(const osg::Image& pyramid, unsigned side);

}  // namespace osgEnvLight
