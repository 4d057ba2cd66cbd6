/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

namespace osgEnvLight
{

struct FrameContext;

/** Whether something in view has a lobe that shows something. */
Requirement requireLobes(const FrameContext& context);

/** First part of S, the glossy term: the map's radiance in each pixel's lobe, by samples of the pixel's own. */
class OSGENVLIGHT_EXPORT SpecularPass : public RenderPass
{
  public:
    const char* name() const override { return "specular"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Second part: the sums of these, and of what the scene leaves of them, averaged over cells along rows. */
class OSGENVLIGHT_EXPORT LobeRowsPass : public RenderPass
{
  public:
    const char* name() const override { return "loberows"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** S of clear coats. */
class OSGENVLIGHT_EXPORT CoatPass : public RenderPass
{
  public:
    const char* name() const override { return "coat"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Last part: the same along columns, and S, with that of coats. */
class OSGENVLIGHT_EXPORT LobesPass : public RenderPass
{
  public:
    const char* name() const override { return "lobes"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** What glossy surfaces show of the scene, first part: rays through the picture, and where that does not show what they meet,
 * through the scene. */
class OSGENVLIGHT_EXPORT ReflectionsPass : public RenderPass
{
  public:
    const char* name() const override { return "reflections"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Last part: their mean over cells, added to the picture. */
class OSGENVLIGHT_EXPORT ReflectionFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "reflectionfilter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
