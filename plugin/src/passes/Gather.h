/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** Whether still views ask for rays through the scene. */
bool gathers(const Settings& settings);

/** What other surfaces send to the pixels of a still view, by rays through the scene: final gathering. */
class OSGENVLIGHT_EXPORT GatherPass : public RenderPass
{
  public:
    const char* name() const override { return "gather"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The mean of what the pixels of a cell gather. */
class OSGENVLIGHT_EXPORT GatherFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "gatherfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
