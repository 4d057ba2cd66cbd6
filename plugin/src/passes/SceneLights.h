/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"

namespace osgEnvLight
{

/** The shadow maps of the application's lights, drawn when lights or casters change, a few a frame. */
class OSGENVLIGHT_EXPORT SceneLightMapsPass : public RenderPass
{
  public:
    SceneLightMapsPass(Failure* failure, RetiredObjects* retired) : _maps(failure, retired) {}

    const char* name() const override { return "scenelightmaps"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return _maps.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override { _maps.resizeGLObjectBuffers(maximum); }
    void releaseGLObjects(osg::State* state) const override { _maps.releaseGLObjects(state); }

  private:
    EmitterMapsOwner _maps;
    std::vector<EmitterPoint> _points;
};

/** Adds what surfaces reflect of the application's lights to the G-buffer's emission: bounce and still views then have it too. */
class OSGENVLIGHT_EXPORT SceneLightsPass : public RenderPass
{
  public:
    const char* name() const override { return "scenelights"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
