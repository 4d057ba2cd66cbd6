/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** Marks the pixels that show a surface, and those of them that have a lobe. Other passes draw only the pixels that they concern. */
class OSGENVLIGHT_EXPORT PixelMarksPass : public RenderPass
{
  public:
    const char* name() const override { return "pixelmarks"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
