// SPDX-License-Identifier: MIT
#include "passes/SeenPoints.h"

#include "base/Limits.h"
#include "passes/AreaLights.h"
#include "passes/Inputs.h"
#include "passes/SkyShadows.h"

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

namespace
{

// Draws the points and reads them back.
class ProbeTriangle : public FullScreen
{
  public:
    using FullScreen::FullScreen;

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        FullScreen::drawImplementation(renderInfo);
        probe->exchange(*renderInfo.getState());
    }

    /** Written at cull by the frame that owns this. */
    osg::ref_ptr<DepthProbe> probe;
};

}  // namespace

Requirement SeenPointsPass::require(const FrameContext& c) const
{
    Requirement probe = c.decisions.atlas.needed ? c.decisions.atlas : c.decisions.sunMaps;
    probe.unless(probe.needed && !mayShowLittle(c), "the view shows most of the scene");
    const Requirement points = requireChosenPoints(c);
    if (!probe.needed && points.needed) probe = points;
    return probe.because("measures what the view shows when it moves");
}

void SeenPointsPass::update(FrameContext& c)
{
    if (!_probe) _probe = new DepthProbe;
    const osg::Matrixd& projection = *c.cv.getProjectionMatrix();
    const bool differs = _worldFromEye != c.worldFromEye || !sameProjection(_projection, projection);
    if (differs || _casters != c.casters.version) _measuredFrames = 0;
    _worldFromEye = c.worldFromEye;
    _projection = projection;
    _casters = c.casters.version;
    if (std::optional<ProbedPoints> seen = _probe->take()) {
        _seen = std::move(*seen);
        c.seen = &_seen;
        if (_measuredFrames >= 2 && _seen.worldFromEye == c.worldFromEye) _measuredFrames = known;
    }
    _measures = _measuredFrames < 2 && !c.isConverged();
    if (_measuredFrames < known) ++_measuredFrames;
    if (_measuredFrames < known) ++c.waitingMaps;
}

void SeenPointsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!_measures) return;
    b.readGBuffer();
    b.write(b.create("seen points", {GL_RGBA32F_ARB, DepthProbe::side}));
    b.triangle([vertices = c.frame.triangle] { return new ProbeTriangle(vertices.get()); },
               [probe = _probe](FullScreen& t) { static_cast<ProbeTriangle&>(t).probe = probe; });
}

void SeenPointsPass::dismiss(FrameContext&)
{
    _probe = nullptr;
    _measuredFrames = 0;
}

void SeenPointsPass::resizeGLObjectBuffers(unsigned maximum)
{
    if (_probe) _probe->resizeGLObjectBuffers(maximum);
}

void SeenPointsPass::releaseGLObjects(osg::State* state) const
{
    if (_probe) _probe->releaseGLObjects(state);
}

}  // namespace osgEnvLight
