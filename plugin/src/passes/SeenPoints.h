/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "shadow/DepthProbe.h"

namespace osgEnvLight
{

/** Reads back some of the points that a view shows, while it or the scene moves and somebody asks: the shadow maps of a large
 * scene and of its suns, and those of more area lights than there are points for. */
class OSGENVLIGHT_EXPORT SeenPointsPass : public RenderPass
{
  public:
    const char* name() const override { return "seen"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override;
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    osg::ref_ptr<DepthProbe> _probe;
    ProbedPoints _seen;
    osg::Matrixd _worldFromEye, _projection;  // that were last measured
    unsigned _casters = 0;                    // their version
    unsigned _measuredFrames = 0;             // since, up to known
    bool _measures = false;                   // in this frame
    /** The second frame publishes what the first has measured; the third's cull knows it or, where the draw runs behind, the
     * fourth's. */
    static constexpr unsigned known = 4;
};

}  // namespace osgEnvLight
