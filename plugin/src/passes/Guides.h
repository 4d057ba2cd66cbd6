/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"
#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** Finds bright places, to which the rays of a still view are aimed. */
class OSGENVLIGHT_EXPORT GuidesPass : public RenderPass
{
  public:
    const char* name() const override { return "guides"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override { _found = false; }

  private:
    bool _found = false;  // in this still view
};

}  // namespace osgEnvLight
