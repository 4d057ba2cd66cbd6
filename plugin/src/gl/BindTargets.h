/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "base/Failure.h"
#include "gl/GpuTimer.h"

#include <osg/Camera>
#include <osg/FrameBufferObject>

#include <set>

namespace osgEnvLight
{

/** Binds a frame buffer, in such a way that State's own record of what is bound stays true. */
OSGENVLIGHT_EXPORT void bindFrameBuffer(osg::State& state, osg::FrameBufferObject& target);

/** Draw callback of a camera that carries one of our stages: binds the stage's frame buffer before it is drawn and the
 * context's own after it. An incomplete frame buffer is reported, once, as the node's failure.*/
class OSGENVLIGHT_EXPORT BindTargets : public osg::Camera::DrawCallback
{
  public:
    /** A pre-draw and a post-draw callback on camera. timer may be null. */
    static void install(osg::Camera& camera, osg::FrameBufferObject* target, GpuTimer* timer, Failure* failure);

    void operator()(osg::RenderInfo& renderInfo) const override;

  private:
    BindTargets(bool before, osg::FrameBufferObject* target, GpuTimer* timer, Failure* failure);

    void check(osg::State& state) const;

    const bool _before;
    const osg::ref_ptr<osg::FrameBufferObject> _target;
    const osg::ref_ptr<GpuTimer> _timer;
    const osg::ref_ptr<Failure> _failure;
    mutable std::set<unsigned> _checked;  // contexts, in whose draw thread alone; a query would make each frame wait for the GPU
};

}  // namespace osgEnvLight
