// SPDX-License-Identifier: MIT
#include "passes/SunPasses.h"

#include "base/Limits.h"
#include "passes/Inputs.h"
#include "passes/SkyShadows.h"
#include "shadow/VisibleBoxes.h"

#include <osgUtil/CullVisitor>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

// A tenth of what the view shows is nearer. 0: this frame has no new measurement of that.
double nearDepth(const FrameContext& c)
{
    if (!mayShowLittle(c)) return 1e30;
    if (!c.seen || c.seen->points.empty()) return 0.0;
    const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(c.seen->worldFromEye);
    std::vector<double> depths;
    for (const osg::Vec3d& p : c.seen->points) depths.push_back(-(p * eyeFromWorld).z());
    const auto tenth = depths.begin() + std::ptrdiff_t(depths.size() / 10);
    std::nth_element(depths.begin(), tenth, depths.end());
    return std::max(*tenth, 0.0);
}

Requirement requireSunMaps(const FrameContext& c)
{
    Requirement shadows = c.decisions.sunMaps;
    return shadows.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
}

std::string numbered(const char* name, unsigned i)
{
    return name + std::to_string(i);
}

// Two suns share a texture.
unsigned pairs(const FrameContext& c)
{
    return (c.facts.suns.count + 1) / 2;
}

// Four share one of what is seen of them.
unsigned fours(const FrameContext& c)
{
    return (c.facts.suns.count + 3) / 4;
}

// What pass/sunpoints.glsl reads.
void readSunPoints(PassBuilder& b, const FrameContext& c)
{
    for (unsigned i = 0; i < pairs(c); ++i) {
        b.read(b.find(numbered("sun points ", i)), numbered("sunSeenMap", i));
        if (i > 0) b.define(numbered("SUNS_OVER_", 2 * i));
    }
}

}  // namespace

Requirement Suns::require(const FrameContext& c) const
{
    return c.decisions.suns;
}

Requirement SunMaps::require(const FrameContext& c) const
{
    return c.decisions.sunMaps;
}

SunShadows& SunMaps::make(unsigned suns, unsigned levels, unsigned size)
{
    SunShadows* maps = _maps.get();
    if (maps && maps->suns == suns) levels = std::max(levels, maps->levels);  // those once there stay
    size = SunShadows::sizeOf(suns * levels, size);
    if (maps && maps->suns == suns && maps->levels == levels && maps->size == size) return *maps;
    return _maps.replace(new SunShadows(suns, levels, size));
}

void SunMaps::update(FrameContext& c)
{
    if (!c.hasFirstFrame()) {
        const ShadowView view{c.worldFromEye, *c.cv.getProjectionMatrix(), c.height(), nearDepth(c)};
        const auto size = unsigned(c.settings.sunShadowSize);
        const VisibleBoxes boxes(c.casters, view);
        const unsigned levels = SunShadows::wantedLevels(c.casters.bound, view, boxes, size);
        SunShadows& shadows = make(c.facts.suns.count, levels, size);
        _maps.refreshes = shadows.update(c.casters, c.inWorld(c.textures->suns()), view, boxes);
        c.drawnSunMaps = unsigned(_maps.refreshes.size());
    }
    c.sunMaps = _maps.get();
}

void SunMaps::setup(PassBuilder& b, FrameContext& c)
{
    _maps.draw(b, c, name(), name(), {"pass/sunmap.frag", nullptr}, [this] { return _maps.get()->casters(); });
}

void SunMaps::dismiss(FrameContext& c)
{
    if (!(c.showsNothing && Decisions::wantsSunMaps(c.settings))) _maps.drop();
}

Requirement SunShadowPass::require(const FrameContext& c) const
{
    return requireSunMaps(c).because("a point of each disc a pixel");
}

void SunShadowPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    b.readGBuffer();
    readSunMaps(b, c);
    b.read("emission", "emissionMap");
    readSuns(b, c);
    drawSurfaces(b);
    for (unsigned i = 0; i < pairs(c); ++i) b.write(b.create(numbered("sun points ", i)), {1, 0, 1, 0});
}

Requirement SunQuadsPass::require(const FrameContext& c) const
{
    return requireSunMaps(c).because("which 2x2 pixels see suns as those about them do");
}

void SunQuadsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    readSunPoints(b, c);
    readSuns(b, c);
    TextureDesc quads;
    quads.half = true;
    b.write(b.create("sun quads", quads));
}

Requirement PenumbraPass::require(const FrameContext& c) const
{
    return requireSunMaps(c).because("where neighbours see suns unlike each other");
}

void PenumbraPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    b.read("depth", "depthMap");
    readSunPoints(b, c);
    readSuns(b, c);
    b.read(b.find("sun quads"), "sunQuadMap");
    b.mark(b.create("penumbrae", {GL_DEPTH_COMPONENT16}));
    for (unsigned i = 0; i < fours(c); ++i) b.write(b.create(numbered("sun visibility ", i)));
}

Requirement SunFilterPass::require(const FrameContext& c) const
{
    return requireSunMaps(c).because("16 points of each disc a pixel in penumbrae");
}

void SunFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    b.readGBuffer();
    readSunMaps(b, c);
    b.read("emission", "emissionMap");
    readSunPoints(b, c);
    readSuns(b, c);
    b.drawMarked(b.find("penumbrae"), limits::MARK_SURFACE);
    for (unsigned i = 0; i < fours(c); ++i) b.drawOver(b.find(numbered("sun visibility ", i)));
}

}  // namespace osgEnvLight
