/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <array>

#include <osg/Texture2D>

namespace osgEnvLight
{

const int ltcSide = 32;
const double ltcUnit = 1e-5;

using LtcTable = std::array<int, 4 * ltcSide * ltcSide>;

/** Linearly transformed cosines of GGX's lobe: lib/ltc.glsl's ltcOf() says what its four values are, in multiples of ltcUnit; 32
 * angles of the view from 0 to a right angle for each of 32 roughnesses from 0 to 1. Made by least squares: plugin/tables. */
extern OSGENVLIGHT_EXPORT const LtcTable ltcTable;

/** The same as RGBA floats. Made at the first call and shared from then on. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> ltcTableImage();

/** For ltcOf(): half floats, which change nothing, linear and clamped. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> makeLtcTable();

}  // namespace osgEnvLight
