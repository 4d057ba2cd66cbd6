// SPDX-License-Identifier: MIT
// The suns' shadow maps of a view: when they are drawn, and what each pixel sees of the suns.
#include <osgEnvLight/DeferredTechnique>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

namespace
{

const unsigned on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

void bind(osg::StateSet& stateSet, unsigned unit, const char* name, osg::Texture* texture)
{
    stateSet.setTextureAttribute(unit, texture, on);
    stateSet.addUniform(new osg::Uniform(name, int(unit)), on);
}

DominantLights inWorld(const DominantLights& suns, const osg::Matrixd& mapFromWorld)
{
    const osg::Matrixd worldFromMap = osg::Matrixd::inverse(mapFromWorld);
    DominantLights result = suns;
    for (DominantLight& sun : result) {
        sun.direction = sun.direction * worldFromMap;
        sun.direction.normalize();
    }
    return result;
}

}  // namespace

AtlasRefresh::States DeferredTechnique::sunMapStates(Cull& c, SunShadows& shadows)
{
    AtlasRefresh::States states;
    for (const bool second : {false, true}) {
        ViewData::State state = c.view.state(second ? "suns' caster second" : "suns' caster first");
        osg::StateSet& s = state.stateSet;
        (second ? states.second : states.first) = &s;
        if (!state.isNew) continue;
        s.setAttribute(_library->program("pass/caster.vert", "pass/caster.frag"), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), on);
        s.addUniform(new osg::Uniform("baseColorMap", 0));
        if (!second) continue;
        s.setDefine("CASTER_SECOND");
        s.setAttribute(new osg::ColorMask(false, false, false, false), on);
        bind(s, 1, "firstDepthMap", shadows.firstDepth());
    }
    ViewData::State state = c.view.state("sunmap");
    states.midpoints = &state.stateSet;
    if (state.isNew) {
        osg::StateSet& s = state.stateSet;
        s.setAttribute(_library->program("pass/fullscreen.vert", "pass/sunmap.frag"), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false), osg::StateAttribute::OFF);
        bind(s, 0, "firstDepthMap", shadows.firstDepth());
        bind(s, 1, "secondDepthMap", shadows.secondDepth());
        bind(s, 2, "firstSlopeMap", shadows.firstSlope());
    }
    return states;
}

void DeferredTechnique::addSunMaps(Cull& c, osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye)
{
    const Plan& plan = c.view.plan;
    _drawnSunMaps = 0;
    if (!plan.sunShadows) c.view.dropSunShadows();
    if (!c.shadesSuns()) return;
    const SunView view{worldFromEye, *cv.getProjectionMatrix(), c.view.height()};
    const auto size = unsigned(c.settings.sunShadowSize);
    const VisibleBoxes boxes(c.casters, view);
    const unsigned levels = SunShadows::wantedLevels(boundOf(c.casters), view, boxes, size);
    SunShadows& shadows = c.view.sunShadows(plan.suns, levels, size);
    const DominantLights suns = inWorld(c.view.textures().suns(), c.mapFromWorld);
    const std::vector<ShadowRefresh> refreshes = shadows.update(c.casters, suns, view, boxes);
    _drawnSunMaps = unsigned(refreshes.size());
    if (refreshes.empty()) return;

    Frame& f = c.frame;
    osg::ref_ptr<AtlasRefresh>& refresh = f.atlasRefreshes["sunmap"];
    if (!refresh) refresh = new AtlasRefresh("sunmap", &c.view.timer("sunmap"));
    refresh->prepare(shadows.targets(), refreshes, std::vector<Caster>(shadows.casters()), sunMapStates(c, shadows), c.timed);
    osg::ref_ptr<Pass>& pass = f.passes["sunmap"];
    if (!pass) pass = new Pass(refresh.get());
    ViewData::State own = c.view.state("sunmaps");
    pass->add(c.host, c.view.sunCamera(), *c.view.viewport(), own.stateSet, *f.uniforms, cv.getProjectionMatrix(),
              cv.getModelViewMatrix());
}

void DeferredTechnique::addSunShadows(Cull& c, osgUtil::CullVisitor& cv, Target& seen, Target& visibility)
{
    SunShadows& shadows = *c.view.sunShadows();
    const ShadowPlaces places{&c.frame.sunState(shadows), shadows.targets().origin};
    for (const bool filter : {false, true}) {
        PassInputs in;
        in.samplers = {{"sunShadowMaps", shadows.texture()}};
        static const char* const names[] = {"sunSeenMap0", "sunSeenMap1", "sunSeenMap2", "sunSeenMap3"};
        for (size_t i = 0; filter && i < 4; ++i)
            in.samplers.push_back({names[i], seen.textures[std::min(i, seen.textures.size() - 1)].get()});
        const char* name = filter ? "sunfilter" : "sunshadow";
        osg::StateSet& state = passState(c, name, in);
        for (const osg::ref_ptr<osg::Uniform>& u : c.view.textures().sunUniforms()) state.addUniform(u.get());
        addPass(c, cv, name, filter ? visibility : seen, state, places);
    }
}

void DeferredTechnique::addSunVisibility(Cull& c, PassInputs& in)
{
    Target& visibility = c.view.target("sunfilter", {});
    in.defines.push_back("HAS_SUN_SHADOWS");
    in.samplers.push_back({"sunVisibilityMap0", visibility.textures.front().get()});
    in.samplers.push_back({"sunVisibilityMap1", visibility.textures.back().get()});
}

}  // namespace osgEnvLight
