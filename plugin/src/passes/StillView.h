/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"

namespace osgEnvLight
{

/** Follows whether a view stands still; then each frame has fresh lights of the map, each with a shadow map of its own. */
class OSGENVLIGHT_EXPORT StillView : public RenderPass
{
  public:
    StillView(Failure* failure, RetiredObjects* retired) : _all(failure, retired), _near(failure, retired) {}

    const char* name() const override { return "stillmaps"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return _all.bytes() + _near.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    ShadowAtlas& updateMaps(const FrameContext& context, AtlasOwner& owner, const ShadowAtlas* near) const;

    osg::ref_ptr<Accumulation> _accumulation;
    AtlasOwner _all, _near;
};

/** Adds the picture of a frame, lit by its own lights, to the average. */
class OSGENVLIGHT_EXPORT AccumulatePass : public RenderPass
{
  public:
    const char* name() const override { return "accumulate"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Reads back now and then how far the average is from converged. */
class OSGENVLIGHT_EXPORT StillErrorPass : public RenderPass
{
  public:
    const char* name() const override { return "stillerror"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
