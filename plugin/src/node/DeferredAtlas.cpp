// SPDX-License-Identifier: MIT
// When the sky shadow atlas of a view is drawn, and with what: the maps of the scene and, in a large one, of what the view shows.
#include "frame/DepthProbePass.h"
#include "node/DeferredTechnique.h"

#include <osgUtil/CullVisitor>

#include <sstream>

namespace osgEnvLight
{

namespace
{

// Where the first frame draws all maps at once instead of a few a frame: as many triangles as a frame of a large model has,
// 256 maps of 40 000 drawn twice.
const double firstFrameTriangles = 2e7;

bool fitsIntoAFrame(const ShadowAtlas& atlas)
{
    return 2.0 * atlas.lights * double(atlas.triangles()) <= firstFrameTriangles;
}

// Whether a view may show less of the box than the largest neighbourhood: the nearest that there may be is less wide in it.
bool mayShowLittle(const osg::BoundingBoxd& box, const ShadowView& view)
{
    const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(view.worldFromEye);
    double depth = 1e300;
    for (unsigned i = 0; i < 8; ++i) depth = std::min(depth, -(box.corner(i) * eyeFromWorld).z());
    depth = std::max(depth, 0.0);
    return (view.at(1, 1, depth) - view.at(-1, -1, depth)).length() < NearCascade::largest * diagonal(box);
}

std::string describe(const osg::BoundingSphered& neighbourhood)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << ", and as many of the view's neighbourhood, " << 2.0 * neighbourhood.radius() << " across";
    return out.str();
}

}  // namespace

ViewData::Atlas& DeferredTechnique::skyAtlas(Cull& c)
{
    return c.view.atlas("atlas", c.view.plan.occlusionLights, unsigned(c.settings.atlasSize));
}

// The atlas of the view's neighbourhood, if there is one; and whether this frame must measure what the view shows.
ViewData::Atlas* DeferredTechnique::finerAtlas(Cull& c, const osg::Matrixd& projection)
{
    ViewData::Surroundings& s = c.view.surroundings;
    const osg::BoundingBoxd box = boundOf(c.casters);
    if (!box.valid() || !mayShowLittle(box, {c.worldFromEye, projection, c.view.height()})) {
        s = {};
        c.view.dropTarget("seen");
    } else {
        if (!s.seen) s.seen = new DepthProbe;
        if (s.worldFromEye != c.worldFromEye || !sameProjection(s.projection, projection)) s.frames = 0;
        s.worldFromEye = c.worldFromEye;
        s.projection = projection;
        const std::optional<ProbedPoints> seen = s.seen->take();
        if (seen) s.neighbourhood.follow(*seen, 0.5 * diagonal(box));
        if (seen && s.frames >= 2 && seen->worldFromEye == c.worldFromEye) s.frames = s.known;
        c.measures = s.frames < 2 || skyAtlas(c).maps->moved();
        if (s.frames < s.known) ++s.frames;
    }
    if (s.neighbourhood.sphere().valid())
        return &c.view.atlas("finer atlas", c.view.plan.occlusionLights, unsigned(c.settings.atlasSize));
    c.view.dropAtlas("finer atlas");
    c.view.dropAtlas("accumulate finer");
    return nullptr;
}

DeferredTechnique::ShadowPlaces DeferredTechnique::placesOf(Cull& c, const std::string& name, const ShadowAtlas& atlas,
                                                            const ShadowAtlas* finer)
{
    return {&c.frame.atlasState(name, atlas, finer, 1.0 / c.view.textures().map().mean), atlas.origin()};
}

void DeferredTechnique::addMaps(PassInputs& in, ShadowAtlas& atlas, ShadowAtlas* finer)
{
    in.samplers.push_back({"atlasMap", atlas.texture()});
    if (!finer) return;
    in.defines.push_back("HAS_NEIGHBOURHOOD");
    in.samplers.push_back({"finerAtlasMap", finer->texture()});
}

void DeferredTechnique::addAtlas(Cull& c, osgUtil::CullVisitor& cv)
{
    if (!c.view.plan.atlas) {
        _waitingMaps = 0;
        if (c.away && FramePlan::wantsAtlas(c.settings)) return;
        c.view.dropAtlas("atlas");
        c.view.dropAtlas("finer atlas");
        c.view.dropTarget("seen");
        c.view.surroundings = {};
        return;
    }
    ViewData::Atlas& own = skyAtlas(c);
    ShadowAtlas& atlas = *own.maps;
    atlas.setCasters(c.casters);
    ViewData::Atlas* finer = finerAtlas(c, *cv.getProjectionMatrix());
    const LightList list = c.view.textures().occlusionList(atlas.lights);
    const auto atOnce = [&](const ShadowAtlas& maps) {
        return c.settings.regeneration == Settings::IMMEDIATE || (maps.version() == 0 && fitsIntoAFrame(maps));
    };
    // Where both atlases wait, they share.
    const unsigned budget = unsigned(c.settings.atlasUpdatesPerFrame);
    const unsigned share = finer && finer->maps->waiting() > 0 ? (budget + 1) / 2 : budget;
    const unsigned drawn = refreshAtlas(c, cv, "atlas", own, list, atOnce(atlas) ? atlas.lights : share);
    unsigned waiting = atlas.waiting();
    if (finer) {
        c.finer = finer->maps.get();
        c.finer->setFocus(c.view.surroundings.neighbourhood.sphere());
        c.finer->setCasters(c.casters);
        refreshAtlas(c, cv, "finer atlas", *finer, list, atOnce(*c.finer) ? atlas.lights : budget - std::min(drawn, budget));
        waiting += c.finer->waiting();
        for (PassReport& r : c.view.plan.passes)
            if (r.pass == "atlas") r.reason += describe(c.finer->focus());
    }
    const ViewData::Surroundings& s = c.view.surroundings;
    _waitingMaps = waiting + (s.frames > 0 && s.frames < s.known ? 1 : 0);
}

unsigned DeferredTechnique::refreshAtlas(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, ViewData::Atlas& own,
                                         const LightList& list, unsigned budget)
{
    ShadowAtlas& atlas = *own.maps;
    LightList lights = inWorld(c, list);
    lights.resize(atlas.lights, DirectionalLight{osg::Vec3d(0, 0, 1), osg::Vec3d()});  // dark ones
    const std::vector<ShadowRefresh> refreshes = atlas.update(lights, budget);
    if (!refreshes.empty()) addRefresh(c, cv, name, "pass/midpoint.frag", *own.camera, atlas.targets(), refreshes, atlas.drawn());
    return unsigned(refreshes.size());
}

void DeferredTechnique::addSeenPoints(Cull& c, osgUtil::CullVisitor& cv, Target& points)
{
    osg::ref_ptr<Pass>& pass = c.frame.passes["seen"];
    if (!pass) pass = new Pass(new DepthProbePass(&c.view.timer("seen")));
    static_cast<DepthProbePass&>(pass->drawable()).buffer = c.view.surroundings.seen;
    PassInputs in;
    in.viewport = points.viewport.get();
    addPass(c, cv, "seen", points, passState(c, "seen", in));
}

}  // namespace osgEnvLight
