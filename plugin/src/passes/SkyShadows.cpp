// SPDX-License-Identifier: MIT
#include "passes/SkyShadows.h"

#include "base/Limits.h"
#include "passes/Inputs.h"
#include "shadow/VisibleBoxes.h"

#include <osgUtil/CullVisitor>

#include <algorithm>
#include <sstream>

namespace osgEnvLight
{

namespace
{

// Maps of a frame while lights lack theirs. The first has a quarter of them, less in a large model, but enough for each of the
// groups: others take the flux of those that have none yet, so that it is a picture, and comes while all of them would still be
// drawn. The rest follow in at least fifteen frames.
unsigned mapsAtFirst(const ShadowAtlas& maps)
{
    const double affordable = firstFrameTriangles / (2.0 * std::max<double>(1.0, double(maps.triangles())));
    const unsigned groups = limits::LIGHT_GROUPS;
    if (maps.hasMap()) return unsigned(std::min(affordable / 4.0, maps.lights / 16.0));
    return std::max(unsigned(std::min(affordable, maps.lights / 4.0)) / groups, 1u) * groups;
}

// @param budget  of maps that exist
unsigned mapsOf(const FrameContext& c, const ShadowAtlas& maps, unsigned budget)
{
    if (c.settings.regeneration == Settings::IMMEDIATE) return maps.lights;
    return maps.complete() ? budget : std::max(budget, mapsAtFirst(maps));
}

// Whether a view may show less of the scene than the largest cascade: the nearest that there may be is less wide in it.
bool mayShowLittle(const FrameContext& c)
{
    const osg::BoundingBoxd& box = c.casters.bound;
    if (!box.valid()) return false;
    const ShadowView view{c.worldFromEye, *c.cv.getProjectionMatrix(), c.height()};
    const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(c.worldFromEye);
    double depth = 1e300;
    for (unsigned i = 0; i < 8; ++i) depth = std::min(depth, -(box.corner(i) * eyeFromWorld).z());
    depth = std::max(depth, 0.0);
    return (view.at(1, 1, depth) - view.at(-1, -1, depth)).length() < NearCascade::largest * diagonal(box);
}

std::string describeFocus(const osg::BoundingSphered& shown)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << ", and as many of the view's neighbourhood, " << 2.0 * shown.radius() << " across";
    return out.str();
}

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

Requirement SkyShadows::require(const FrameContext& c) const
{
    return c.decisions.atlas;
}

// Find out how much of the scene the view shows: whether there is a part of it that is worth finer maps.
bool SkyShadows::followView(FrameContext& c, const ShadowAtlas& all)
{
    if (!mayShowLittle(c)) {
        forgetView();
        return false;
    }
    if (!_probe) _probe = new DepthProbe;
    const osg::Matrixd& projection = *c.cv.getProjectionMatrix();
    if (_worldFromEye != c.worldFromEye || !sameProjection(_projection, projection)) _measuredFrames = 0;
    _worldFromEye = c.worldFromEye;
    _projection = projection;
    const std::optional<ProbedPoints> seen = _probe->take();
    if (seen) _cascade.follow(*seen, 0.5 * diagonal(c.casters.bound));
    if (seen && _measuredFrames >= 2 && seen->worldFromEye == c.worldFromEye) _measuredFrames = known;
    if (_measuredFrames < 2 || all.moved()) c.probe = _probe.get();
    if (_measuredFrames < known) ++_measuredFrames;
    return _cascade.sphere().valid();
}

void SkyShadows::forgetView()
{
    _cascade = {};
    _probe = nullptr;
    _measuredFrames = 0;
}

void SkyShadows::update(FrameContext& c)
{
    const unsigned lights = c.decisions.occlusionLights;
    const auto size = unsigned(c.settings.atlasSize);
    ShadowAtlas& all = _all.make(lights, size);
    all.setCasters(c.casters);
    const bool needsNear = followView(c, all);
    if (!needsNear) _near.drop();
    ShadowAtlas* near = needsNear ? &_near.make(lights, size) : nullptr;
    const LightList list = c.textures->occlusionList(lights);
    // Where both atlases wait, they share.
    const auto budget = unsigned(c.settings.atlasUpdatesPerFrame);
    const unsigned share = near && near->waiting() > 0 ? (budget + 1) / 2 : budget;
    const unsigned drawn = _all.update(c, list, mapsOf(c, all, share));
    c.skyMaps = &all;
    c.waitingMaps = all.waiting();
    if (near) {
        near->setFocus(_cascade.sphere());
        near->setCasters(c.casters);
        _near.update(c, list, mapsOf(c, *near, budget - std::min(drawn, budget)));
        c.nearSkyMaps = near;
        c.waitingMaps += near->waiting();
    }
    if (_measuredFrames > 0 && _measuredFrames < known) ++c.waitingMaps;
}

void SkyShadows::setup(PassBuilder& b, FrameContext& c)
{
    if (c.nearSkyMaps) c.remark(describeFocus(c.nearSkyMaps->focus()));
    _all.draw(b, c, name(), "atlas");
    _near.draw(b, c, name(), "near atlas");
}

void SkyShadows::dismiss(FrameContext& c)
{
    if (c.showsNothing && Decisions::wantsAtlas(c.settings)) return;
    _all.drop();
    _near.drop();
    forgetView();
}

void SkyShadows::resizeGLObjectBuffers(unsigned maximum)
{
    _all.resizeGLObjectBuffers(maximum);
    _near.resizeGLObjectBuffers(maximum);
    if (_probe) _probe->resizeGLObjectBuffers(maximum);
}

void SkyShadows::releaseGLObjects(osg::State* state) const
{
    _all.releaseGLObjects(state);
    _near.releaseGLObjects(state);
    if (_probe) _probe->releaseGLObjects(state);
}

Requirement DepthProbePass::require(const FrameContext& c) const
{
    Requirement probe = c.decisions.atlas;
    probe.unless(probe.needed && !mayShowLittle(c), "the view shows most of the scene");
    return probe.because("measures what the view shows when it moves");
}

void DepthProbePass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.probe || c.isConverged()) return;
    b.readGBuffer();
    b.write(b.create("seen points", {GL_RGBA32F_ARB, DepthProbe::side}));
    b.triangle([vertices = c.frame.triangle] { return new ProbeTriangle(vertices.get()); },
               [probe = osg::ref_ptr<DepthProbe>(c.probe)](FullScreen& t) { static_cast<ProbeTriangle&>(t).probe = probe; });
}

}  // namespace osgEnvLight
