/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Matrixd>

namespace osgUtil
{
class StateGraph;
}

namespace osgEnvLight
{

/** How a host's depth buffer holds distances: as OpenGL's default, or from 1 at the eye to 0 (reversed), by clip coordinates
 * from 0 to 1 (osg::ClipControl), in a part of its range (osg::Depth). The G-buffer's depth always grows from 0 to 1 away from
 * the eye, so that no pass of ours need know.*/
struct OSGENVLIGHT_EXPORT DepthConvention {
    bool zeroToOne = false;  // clip coordinates
    bool reversed = false;   // the nearest is the greatest
    double near = 0.0;       // osg::Depth's range
    double far = 1.0;

    /** As the state sets down to the graph say. */
    static DepthConvention of(const osgUtil::StateGraph& graph);

    /** Whether clip coordinates grow away from the eye. */
    bool grows() const { return reversed == (far < near); }
    /** From the host's clip coordinates to those of the G-buffer's depth. */
    osg::Matrixd fromHostClip() const;
    /** From the G-buffer's depth to the host's: offset and factor. */
    osg::Vec2d toHostDepth() const { return grows() ? osg::Vec2d(near, far - near) : osg::Vec2d(far, near - far); }
};

}  // namespace osgEnvLight
