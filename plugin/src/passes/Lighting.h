/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** D: the diffuse term of the map and of the suns, without occlusion. */
class OSGENVLIGHT_EXPORT DiffusePass : public RenderPass
{
  public:
    const char* name() const override { return "diffuse"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
