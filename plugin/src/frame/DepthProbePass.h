/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/Pass.h"
#include "shadow/DepthProbe.h"

namespace osgEnvLight
{

/** The pass that measures. */
class OSGENVLIGHT_EXPORT DepthProbePass : public FullScreen
{
  public:
    explicit DepthProbePass(GpuTimer* timer) : FullScreen("seen", timer) {}
    void drawImplementation(osg::RenderInfo& renderInfo) const override;

    /** Written at cull by the frame that owns this. */
    osg::ref_ptr<DepthProbe> buffer;
};

}  // namespace osgEnvLight
