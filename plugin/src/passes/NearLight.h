/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** The share of directions in which the probes of a scene may see the map, for rays to look for surfaces close by. 0: none do. */
double mostOpenForNearLight(const Settings& settings);

/** Whether these passes run. */
Requirement requireNearLight(const FrameContext& context);

/** What surfaces close to a pixel send to it, by a ray a pixel. Probes are farther apart than that: they mix the light of such a
 * surface with that of others, and things would seem to float above what they stand on. */
class OSGENVLIGHT_EXPORT NearLightPass : public RenderPass
{
  public:
    const char* name() const override { return "nearlight"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The mean over a cell, in place of that share of what the probes say. */
class OSGENVLIGHT_EXPORT NearLightFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "nearlightfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
