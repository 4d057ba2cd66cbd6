/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

namespace osgEnvLight
{

/** The picture, averaged over the frames before: each is shifted by a part of a pixel, which smooths edges, and a surface is
 * looked up where the frame before showed it [Yang, Liu and Salvi 2020]. A still view goes over to its own average. */
class OSGENVLIGHT_EXPORT TemporalPass : public RenderPass
{
  public:
    const char* name() const override { return "temporal"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;

  private:
    bool _hasPicture = false;  // of the last frame, of whatever size
    bool _continues = false;   // that has the size of this one
    int _side = 0;             // of the two pictures, the one that is drawn
};

}  // namespace osgEnvLight
