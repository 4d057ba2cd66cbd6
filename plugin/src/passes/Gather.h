/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"
#include "frame/RenderPass.h"

#include <string>

namespace osgEnvLight
{

/** Whether still views ask for rays through the scene. */
bool gathers(const Settings& settings);

/** Whether the scene of a still view can be met by rays. */
Requirement requireGather(const FrameContext& context);

/** What pass/pathlight.glsl reads. */
void readPathLight(PassBuilder& builder, FrameContext& context, const std::string& pass);

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
