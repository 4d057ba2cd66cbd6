/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"
#include "shadow/DepthProbe.h"
#include "shadow/NearCascade.h"

namespace osgEnvLight
{

/** The sky shadow atlas: a shadow map for each light of the map's list, drawn when they change, a few a frame; and in a large
 * scene an atlas of the same lights for the part that the view shows.*/
class OSGENVLIGHT_EXPORT SkyShadows : public RenderPass
{
  public:
    SkyShadows(Failure* failure, RetiredObjects* retired) : _all(failure, retired), _near(failure, retired) {}

    const char* name() const override { return "atlas"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return _all.bytes() + _near.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    bool followView(FrameContext& context, const ShadowAtlas& all);
    void forgetView();

    AtlasOwner _all, _near;
    NearCascade _cascade;
    osg::ref_ptr<DepthProbe> _probe;
    osg::Matrixd _worldFromEye, _projection;  // that were last measured
    unsigned _measuredFrames = 0;             // since, up to known
    /** The second frame publishes what the first has measured; the third's cull knows it or, where the draw runs behind, the
     * fourth's. */
    static constexpr unsigned known = 4;
};

/** Reads back what a view of a large scene shows, in the frames in which SkyShadows asks for it. */
class OSGENVLIGHT_EXPORT DepthProbePass : public RenderPass
{
  public:
    const char* name() const override { return "seen"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
