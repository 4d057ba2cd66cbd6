// SPDX-License-Identifier: MIT
#include "passes/MapRefresh.h"

#include "gl/TargetTexture.h"

#include <osg/ColorMask>
#include <osg/Depth>

#include <utility>

namespace osgEnvLight
{

namespace
{

AtlasRefresh::States statesOf(PassBuilder& b, FrameContext& c, const MapShaders& shaders, const ShadowTargets& targets)
{
    AtlasRefresh::States states;
    for (const bool second : {false, true}) {
        const StateSets::State state =
            b.states().get({second ? "second surface" : "first surface", {}, {targets.firstDepth.get()}});
        osg::StateSet& s = state.stateSet;
        (second ? states.second : states.first) = &s;
        if (!state.isNew) continue;
        s.setAttribute(c.shaders.program("pass/caster.vert", "pass/caster.frag"), fixedOn);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), fixedOn);
        s.setMode(GL_DEPTH_CLAMP, fixedOn);  // what lies above a map's heights casts shadows into it
        s.addUniform(new osg::Uniform("baseColorMap", 0));
        if (shaders.define) s.setDefine(shaders.define);
        if (!second) continue;
        s.setDefine("CASTER_SECOND");
        s.setAttribute(new osg::ColorMask(false, true, false, false), fixedOn);  // beside the first one's slope
        // The last unit: textures that move vertices may be on those before it.
        StateSets::bind(s, 15, {"firstDepthMap", targets.firstDepth.get()});
    }
    const StateSets::State state = b.states().get({shaders.middles, {}, {targets.firstDepth.get()}});
    states.midpoints = &state.stateSet;
    if (state.isNew) {
        osg::StateSet& s = state.stateSet;
        s.setAttribute(c.shaders.program("pass/fullscreen.vert", shaders.middles), fixedOn);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false), osg::StateAttribute::OFF);
        StateSets::bind(s, 0, {"firstDepthMap", targets.firstDepth.get()});
        StateSets::bind(s, 1, {"secondDepthMap", targets.secondDepth.get()});
        StateSets::bind(s, 2, {"firstSlopeMap", targets.firstSlope.get()});
    }
    return states;
}

}  // namespace

Requirement requireEmitterMaps(const FrameContext& c, Requirement lights)
{
    lights.unless(!c.settings.occlusion, "occlusion is off");
    lights.unless(c.settings.visibility == Settings::VISIBILITY_NONE, "visibility is none");
    lights.unless(c.facts.surfaces.deferred + c.facts.surfaces.litForward == 0, "nothing to light");
    return lights.unless(c.facts.casters == 0, "nothing casts shadows");
}

void drawMaps(PassBuilder& b, FrameContext& c, const char* pass, const std::string& name, const MapShaders& shaders,
              osg::Camera& camera, const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes,
              std::vector<Caster>&& casters)
{
    AtlasRefresh& refresh = c.frame.refresh(name);
    refresh.prepare(targets, refreshes, std::move(casters), statesOf(b, c, shaders, targets), c.timed(pass));
    b.draw({name, &refresh, &camera});
}

void retire(const ShadowTargets& targets, RetiredObjects& retired)
{
    for (osg::Texture2D* t : targets.textures()) retired.add(t);
    for (osg::FrameBufferObject* f : targets.frameBuffers()) retired.add(f);
}

ShadowAtlas& AtlasOwner::make(unsigned lights, unsigned size)
{
    const ShadowAtlas* maps = get();
    return maps && maps->lights == lights && maps->size == size ? *get() : replace(new ShadowAtlas(lights, size));
}

unsigned AtlasOwner::update(const FrameContext& c, const LightList& list, unsigned budget)
{
    LightList lights = c.inWorld(list);
    lights.resize(get()->lights, DirectionalLight{osg::Vec3d(0, 0, 1), osg::Vec3d()});  // dark ones
    refreshes = get()->update(lights, budget);
    return get()->spent();
}

void AtlasOwner::draw(PassBuilder& b, FrameContext& c, const char* pass, const std::string& name)
{
    MapsOwner::draw(b, c, pass, name, {"pass/midpoint.frag", "CASTER_FLOORS_FIRST"}, [this] { return get()->drawn(); });
}

EmitterMaps& EmitterMapsOwner::update(FrameContext& c, const std::vector<EmitterPoint>& points, unsigned size, bool all)
{
    if (!get() || get()->points != points.size() || get()->size != size) {
        replace(new EmitterMaps(unsigned(points.size()), size));
        _points = nullptr;
    }
    EmitterMaps& maps = *get();
    maps.setCasters(c.casters);
    const bool fits = 2.0 * maps.points * double(maps.triangles()) <= firstFrameTriangles;
    all = all || c.settings.regeneration == Settings::IMMEDIATE || (maps.version() == 0 && fits);
    refreshes = maps.update(points, all ? maps.points : unsigned(c.settings.atlasUpdatesPerFrame));
    if (!_points || _pointVersion != maps.version()) _points = tableTexture(maps.pointImage());
    _pointVersion = maps.version();
    c.waitingMaps += maps.waiting();
    return maps;
}

void EmitterMapsOwner::drop()
{
    MapsOwner::drop();
    _points = nullptr;
}

void EmitterMapsOwner::draw(PassBuilder& b, FrameContext& c, const char* pass, const std::string& name)
{
    MapsOwner::draw(b, c, pass, name, {"pass/emittermap.frag", "CASTER_PERSPECTIVE"}, [this] { return get()->drawn(); });
}

}  // namespace osgEnvLight
