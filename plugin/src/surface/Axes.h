/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Matrixd>
#include <osg/Vec3d>

#include <cmath>

namespace osgEnvLight
{

/** Where the matrix takes an axis, without its shift. */
inline osg::Vec3d axisOf(const osg::Matrixd& m, int axis)
{
    return osg::Vec3d(m(axis, 0), m(axis, 1), m(axis, 2));
}

/** By which the matrix scales volumes; negative if it mirrors. */
inline double volumeScaleOf(const osg::Matrixd& m)
{
    return (axisOf(m, 0) ^ axisOf(m, 1)) * axisOf(m, 2);
}

inline bool mirrors(const osg::Matrixd& m)
{
    return volumeScaleOf(m) < 0.0;
}

/** A unit vector at right angles to the unit vector n. */
inline osg::Vec3d besides(const osg::Vec3d& n)
{
    osg::Vec3d u = std::abs(n.x()) < 0.6 ? osg::Vec3d(1, 0, 0) ^ n : osg::Vec3d(0, 1, 0) ^ n;
    u.normalize();
    return u;
}

}  // namespace osgEnvLight
