/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"

#include <osg/Shader>
#include <osg/StateSet>
#include <osg/ref_ptr>

#include <map>

namespace osgEnvLight
{

/** Motion vectors: where the frame before showed what a pixel shows now, of the pixels whose surface has moved since. */
class OSGENVLIGHT_EXPORT MotionPass : public RenderPass
{
  public:
    const char* name() const override { return "motion"; }
    const char* vertexShader() const override { return "motion"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    osg::StateSet* programOf(const osg::StateSet& caster);

    // By the application's shader [SurfaceProgram]: what draws it here.
    std::map<osg::ref_ptr<const osg::Shader>, osg::ref_ptr<osg::StateSet>> _programs;
};

}  // namespace osgEnvLight
