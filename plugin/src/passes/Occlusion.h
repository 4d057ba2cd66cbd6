/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/PassBuilder.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** First part of O: each pixel of a 4x4 cell sums another group of the map's lights, those that it sees and all. */
class OSGENVLIGHT_EXPORT OcclusionPass : public RenderPass
{
  public:
    const char* name() const override { return "occlusion"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The same of surfaces with a lobe, and what they see of the lights in it. */
class OSGENVLIGHT_EXPORT GlossyOcclusionPass : public RenderPass
{
  public:
    const char* name() const override { return "glossyocclusion"; }
    const char* shader() const override { return "occlusion"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Second part: these sums, averaged over cells along rows. */
class OSGENVLIGHT_EXPORT FilterRowsPass : public RenderPass
{
  public:
    const char* name() const override { return "filterrows"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Last part: the same along columns, and the sums' ratio. */
class OSGENVLIGHT_EXPORT FilterPass : public RenderPass
{
  public:
    const char* name() const override { return "filter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** What a pass writes whose sums are filtered [pass/lightsums.glsl]. */
void writeSums(PassBuilder& builder, const char* sums, const char* places);
/** The filter's two parts, of whose sums these are.
 * @param elsewhere  where there is no surface: all is seen */
void filterRows(PassBuilder& builder, const char* sums, const char* places, const char* rowSums, const char* rowPlaces);
void filterColumns(PassBuilder& builder, const char* rowSums, const char* rowPlaces, TextureId result, float elsewhere = 1.0f);

/** Sums of the radiance that blocked directions show, over blocks of the picture. */
class OSGENVLIGHT_EXPORT BouncePass : public RenderPass
{
  public:
    const char* name() const override { return "bounce"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Those sums over all blocks. */
class OSGENVLIGHT_EXPORT BounceSumPass : public RenderPass
{
  public:
    const char* name() const override { return "bouncesum"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
