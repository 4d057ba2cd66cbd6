/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** Rays look for surfaces close by in scenes whose TransportScene::openShare is this at most. 0: in none. */
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

/** The mean of that light over a cell. It replaces the probes' light in the share of directions that these surfaces fill. */
class OSGENVLIGHT_EXPORT NearLightFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "nearlightfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
