/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** The radiance of the map behind the scene. */
class OSGENVLIGHT_EXPORT BackgroundPass : public RenderPass
{
  public:
    const char* name() const override { return "background"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** L = L_e + S + D - O and the bounce: the radiance of the surfaces, beside that. What adds light later adds to it. */
class OSGENVLIGHT_EXPORT ResolvePass : public RenderPass
{
  public:
    const char* name() const override { return "resolve"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The picture as a display shows it: where the composite smooths its edges. */
class OSGENVLIGHT_EXPORT DisplayPass : public RenderPass
{
  public:
    const char* name() const override { return "display"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** The picture, or any intermediate in its place, into the host's colour and depth. */
class OSGENVLIGHT_EXPORT CompositePass : public RenderPass
{
  public:
    const char* name() const override { return "composite"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** What the transparent surfaces of the host are drawn with, after the composite and in its own bins. */
class OSGENVLIGHT_EXPORT ForwardPass : public RenderPass
{
  public:
    const char* name() const override { return "forward"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
