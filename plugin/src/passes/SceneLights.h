/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"

namespace osgEnvLight
{

/** The shadow maps of the application's lights, drawn when lights or casters change, a few a frame. */
class OSGENVLIGHT_EXPORT SceneLightMapsPass : public MapsPass<EmitterMapsOwner>
{
  public:
    using MapsPass::MapsPass;

    const char* name() const override { return "scenelightmaps"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;

  private:
    std::vector<EmitterPoint> _points;
};

/** Adds what surfaces reflect of the application's lights to the G-buffer's emission: bounce and still views then have it too. */
class OSGENVLIGHT_EXPORT SceneLightsPass : public RenderPass
{
  public:
    const char* name() const override { return "scenelights"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
