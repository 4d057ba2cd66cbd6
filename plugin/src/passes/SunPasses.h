/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"

namespace osgEnvLight
{

/** Draws nothing: the line of the plan that says which suns there are. */
class OSGENVLIGHT_EXPORT Suns : public RenderPass
{
  public:
    const char* name() const override { return "suns"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder&, FrameContext&) override {}
};

/** The suns' shadow maps of a view, drawn when they change. */
class OSGENVLIGHT_EXPORT SunMaps : public MapsPass<MapsOwner<SunShadows>>
{
  public:
    using MapsPass::MapsPass;

    const char* name() const override { return "sunmap"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;

  private:
    SunShadows& make(unsigned suns, unsigned levels, unsigned size);
};

/** What each pixel sees of the suns, by one point of each disc. */
class OSGENVLIGHT_EXPORT SunShadowPass : public RenderPass
{
  public:
    const char* name() const override { return "sunshadow"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The quads of 2x2 pixels that see the suns as those about them do. */
class OSGENVLIGHT_EXPORT SunQuadsPass : public RenderPass
{
  public:
    const char* name() const override { return "sunquads"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** What each pixel of such quads sees; the pixels of the others, marked. */
class OSGENVLIGHT_EXPORT PenumbraPass : public RenderPass
{
  public:
    const char* name() const override { return "penumbrae"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** What the marked pixels see: more points of their own, and their neighbours'. */
class OSGENVLIGHT_EXPORT SunFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "sunfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
