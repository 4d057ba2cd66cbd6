/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"
#include "shadow/NearCascade.h"

namespace osgEnvLight
{

/** The sky shadow atlas: a shadow map for each light of the map's list, drawn when they change, a few a frame; and in a large
 * scene an atlas of the same lights for the part that the view shows.*/
class OSGENVLIGHT_EXPORT SkyShadows : public RenderPass
{
  public:
    SkyShadows(Failure* failure, RetiredObjects* retired) : _all(failure, retired), _near(failure, retired) {}

    const char* name() const override { return "atlas"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return _all.bytes() + _near.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    AtlasOwner _all, _near;
    NearCascade _cascade;
};

/** Whether a view may show so little of the scene that finer maps of that part are worth it. */
bool mayShowLittle(const FrameContext& context);

}  // namespace osgEnvLight
