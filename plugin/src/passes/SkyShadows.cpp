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

std::string describeFocus(const osg::BoundingSphered& shown)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << ", and as many of the view's neighbourhood, " << 2.0 * shown.radius() << " across";
    return out.str();
}

}  // namespace

// It shows less than the largest cascade: the nearest that there may be is less wide in it.
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

Requirement SkyShadows::require(const FrameContext& c) const
{
    return c.decisions.atlas;
}

void SkyShadows::update(FrameContext& c)
{
    const unsigned lights = c.decisions.occlusionLights;
    const auto size = unsigned(c.settings.atlasSize);
    ShadowAtlas& all = _all.make(lights, size);
    all.setCasters(c.casters);
    if (!mayShowLittle(c))
        _cascade = {};
    else if (c.seen)
        _cascade.follow(*c.seen, 0.5 * diagonal(c.casters.bound));
    const bool needsNear = _cascade.sphere().valid();
    if (!needsNear) _near.drop();
    ShadowAtlas* near = needsNear ? &_near.make(lights, size) : nullptr;
    const LightList list = c.textures->occlusionList(lights);
    // Where both atlases wait, they share.
    const auto budget = unsigned(c.settings.atlasUpdatesPerFrame);
    const unsigned share = near && near->waiting() > 0 ? (budget + 1) / 2 : budget;
    const unsigned drawn = _all.update(c, list, mapsOf(c, all, share));
    c.skyMaps = &all;
    c.waitingMaps += all.waiting();
    if (near) {
        near->setFocus(_cascade.sphere());
        near->setCasters(c.casters);
        _near.update(c, list, mapsOf(c, *near, budget - std::min(drawn, budget)));
        c.nearSkyMaps = near;
        c.waitingMaps += near->waiting();
    }
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
    _cascade = {};
}

void SkyShadows::resizeGLObjectBuffers(unsigned maximum)
{
    _all.resizeGLObjectBuffers(maximum);
    _near.resizeGLObjectBuffers(maximum);
}

void SkyShadows::releaseGLObjects(osg::State* state) const
{
    _all.releaseGLObjects(state);
    _near.releaseGLObjects(state);
}

}  // namespace osgEnvLight
