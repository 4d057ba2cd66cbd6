/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

#include <osg/FrameStamp>
#include <osg/Matrixd>

namespace osgEnvLight
{

/** The light that the surfaces in view receive. */
class OSGENVLIGHT_EXPORT MeterPass : public RenderPass
{
  public:
    const char* name() const override { return "meter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** Seconds between two frames. It takes the simulation time; the reference time if that stands still; 1/60 if both do. */
OSGENVLIGHT_EXPORT double secondsBetween(const osg::FrameStamp* former, const osg::FrameStamp* now);

/** The stops that are added to the map's exposure. They follow that light in time and stay on the GPU, where the next frame goes
 * on from them. */
class OSGENVLIGHT_EXPORT AdaptationPass : public RenderPass
{
  public:
    const char* name() const override { return "adaptation"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;

  private:
    bool changes(const FrameContext& context) const;

    bool _hasStops = false;
    int _side = 0;
    osg::ref_ptr<osg::FrameStamp> _former;
    double _stillFor = 0.0;  // seconds, for all that is known here
    unsigned _casters = 0;
};

}  // namespace osgEnvLight
