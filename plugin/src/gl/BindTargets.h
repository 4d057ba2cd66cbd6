/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "base/Failure.h"
#include "gl/FrameTimer.h"

#include <osg/Camera>
#include <osg/FrameBufferObject>

#include <memory>
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
    /** A pre-draw and a post-draw callback on camera.
     * @param timed  measures what is drawn between them; null: nothing does */
    static void install(osg::Camera& camera, osg::FrameBufferObject* target, Failure* failure,
                        const std::shared_ptr<const TimedDraw>& timed = nullptr);

    void operator()(osg::RenderInfo& renderInfo) const override;

  private:
    BindTargets(bool before, osg::FrameBufferObject* target, Failure* failure, const std::shared_ptr<const TimedDraw>& timed);

    void check(osg::State& state) const;

    const bool _before;
    const osg::ref_ptr<osg::FrameBufferObject> _target;
    const std::shared_ptr<const TimedDraw> _timed;
    const osg::ref_ptr<Failure> _failure;
    mutable std::set<unsigned> _checked;  // contexts, in whose draw thread alone; a query would make each frame wait for the GPU
};

}  // namespace osgEnvLight
