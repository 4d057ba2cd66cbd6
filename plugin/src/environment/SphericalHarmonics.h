/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Vec3d>

namespace osgEnvLight
{

/** Band l = 0, 1, 2 or 4 of coefficient i of the 18 that lib/sh.glsl names. */
OSGENVLIGHT_EXPORT int harmonicBand(int i);

/** All real orthonormal harmonics of the bands 0..lastBand (at most 8) at the unit direction d: index l (l + 1) + m, no
 * Condon-Shortley sign. By the Legendre recursion in double.*/
OSGENVLIGHT_EXPORT void evaluateHarmonics(int lastBand, const osg::Vec3d& d, double* result);

/** A_l of the clamped cosine: irradiance is sum A_l L_lm Y_lm [Ramamoorthi, Hanrahan 2001]: pi, 2 pi/3, pi/4, 0, -pi/24,
 * 0, pi/64 ... Any l >= 0.*/
OSGENVLIGHT_EXPORT double cosineBand(int l);

}  // namespace osgEnvLight
