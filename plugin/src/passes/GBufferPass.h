/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "frame/FrameContext.h"
#include "frame/RenderPass.h"
#include "frame/StateSets.h"
#include "surface/SurfaceSorter.h"

#include <functional>

namespace osgEnvLight
{

/** Fills the G-buffer with what the host culls below the node, on a stage before the host's own. */
class OSGENVLIGHT_EXPORT GBufferPass : public RenderPass
{
  public:
    GBufferPass(SurfaceSorter* sorter, Failure* failure) : _sorter(sorter), _failure(failure) {}

    const char* name() const override { return "gbuffer"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;

    /** Before the graph runs, in two steps: the first needs the node's lock, the second culls with traverse() into the frame's
     * G-buffer stage.
     * @param sunny    whether there may be shadow maps of suns
     * @param forward  receives what is drawn after the composite */
    void prepareFrame(FrameContext& context, bool sunny);
    SurfaceKinds cull(FrameContext& context, const std::function<void()>& traverse, std::vector<ForwardGraph>& forward);

  private:
    osg::StateSet& state(FrameContext& context, bool sunny);

    const osg::ref_ptr<SurfaceSorter> _sorter;
    const osg::ref_ptr<Failure> _failure;
    StateSets _states;
};

}  // namespace osgEnvLight
