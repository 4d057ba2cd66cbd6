/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** Whether still views follow a ray in the lobe of each pixel. */
Requirement requireLobeRays(const FrameContext& context);

/** What glossy surfaces show of the scene in a still view, first part: what a ray in a pixel's lobe meets, and what of the map
 * that hides. */
class OSGENVLIGHT_EXPORT LobeRaysPass : public RenderPass
{
  public:
    const char* name() const override { return "loberays"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Second part: what the surfaces that are met send back. */
class OSGENVLIGHT_EXPORT LobeRayLightPass : public RenderPass
{
  public:
    const char* name() const override { return "loberaylight"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Last part: their mean over the pixels of a cell. */
class OSGENVLIGHT_EXPORT LobeRayFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "loberayfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
