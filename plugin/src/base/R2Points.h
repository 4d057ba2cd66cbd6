/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Vec2d>

#include <cmath>

namespace osgEnvLight
{

/** In [0,1): what is left of x without its whole part. */
inline double wrapped(double x)
{
    return x - std::floor(x);
}

/** Point i of the R2 sequence [Roberts 2018], in [0,1)^2: well spread wherever it is cut. */
inline osg::Vec2d r2Point(unsigned i)
{
    // 1/g^2 and 1/g, g^3 = g + 1: the better one goes round a map, where walls cut more than over its height.
    const double x = 0.5 + 0.5698402909980532 * i;
    const double y = 0.5 + 0.7548776662466927 * i;
    return osg::Vec2d(wrapped(x), wrapped(y));
}

}  // namespace osgEnvLight
