// SPDX-License-Identifier: MIT
// When the sky shadow atlas of a view is drawn, and with what.
#include <osgEnvLight/DeferredTechnique>

#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osgUtil/CullVisitor>
#include <osgViewer/View>

namespace osgEnvLight
{

namespace
{

const unsigned on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

// Where the first frame draws all maps at once instead of a few a frame: as many triangles as a frame of a large model has,
// 256 maps of 40 000 drawn twice.
const double firstFrameTriangles = 2e7;

// Filled up with dark lights.
LightList inWorld(const LightList& lights, const osg::Matrixd& mapFromWorld, unsigned count)
{
    const osg::Matrixd worldFromMap = osg::Matrixd::inverse(mapFromWorld);
    LightList result = lights;
    result.resize(count, DirectionalLight{osg::Vec3d(0, 0, 1), osg::Vec3d()});
    for (DirectionalLight& light : result) {
        light.direction = light.direction * worldFromMap;
        light.direction.normalize();
    }
    return result;
}

void bind(osg::StateSet& stateSet, unsigned unit, const char* name, osg::Texture* texture)
{
    stateSet.setTextureAttribute(unit, texture, on);
    stateSet.addUniform(new osg::Uniform(name, int(unit)), on);
}

}  // namespace

AtlasRefresh::States DeferredTechnique::atlasStates(Cull& c, const std::string& name, ShadowAtlas& atlas)
{
    AtlasRefresh::States states;
    for (const bool second : {false, true}) {
        ViewData::State state = c.view.state(name + (second ? " casters second" : " casters first"));
        osg::StateSet& s = state.stateSet;
        (second ? states.second : states.first) = &s;
        if (!state.isNew) continue;
        s.setAttribute(_library->program("pass/caster.vert", "pass/caster.frag"), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), on);
        s.addUniform(new osg::Uniform("baseColorMap", 0));
        if (!second) continue;
        s.setDefine("CASTER_SECOND");
        s.setAttribute(new osg::ColorMask(false, false, false, false), on);
        bind(s, 1, "firstDepthMap", atlas.firstDepth());
    }
    ViewData::State state = c.view.state(name + " midpoint");
    states.midpoints = &state.stateSet;
    if (state.isNew) {
        osg::StateSet& s = state.stateSet;
        s.setAttribute(_library->program("pass/fullscreen.vert", "pass/midpoint.frag"), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false), osg::StateAttribute::OFF);
        bind(s, 0, "firstDepthMap", atlas.firstDepth());
        bind(s, 1, "secondDepthMap", atlas.secondDepth());
        bind(s, 2, "firstSlopeMap", atlas.firstSlope());
    }
    return states;
}

ViewData::Atlas& DeferredTechnique::skyAtlas(Cull& c)
{
    return c.view.atlas("atlas", c.view.plan.occlusionLights, unsigned(c.settings.atlasSize));
}

DeferredTechnique::ShadowPlaces DeferredTechnique::placesOf(Cull& c, const ShadowAtlas& atlas)
{
    return {&c.frame.atlasState(atlas, 1.0 / c.view.textures().map().mean), atlas.origin()};
}

void DeferredTechnique::addAtlas(Cull& c, osgUtil::CullVisitor& cv)
{
    if (!c.view.plan.atlas) {
        c.view.dropAtlas("atlas");
        _waitingMaps = 0;
        return;
    }
    ViewData::Atlas& own = skyAtlas(c);
    ShadowAtlas& atlas = *own.maps;
    atlas.setCasters(c.casters);
    const bool atOnce = c.settings.regeneration == Settings::IMMEDIATE ||
                        (atlas.version() == 0 && 2.0 * atlas.lights * double(atlas.triangles()) <= firstFrameTriangles);
    refreshAtlas(c, cv, "atlas", own, c.view.textures().occlusionList(atlas.lights),
                 atOnce ? atlas.lights : unsigned(c.settings.atlasUpdatesPerFrame));
    _waitingMaps = atlas.waiting();
    if (auto* view = dynamic_cast<osgViewer::View*>(cv.getRenderInfo().getView()); view && atlas.waiting() > 0)
        view->requestRedraw();
}

void DeferredTechnique::refreshAtlas(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, ViewData::Atlas& own,
                                     const LightList& list, unsigned budget)
{
    ShadowAtlas& atlas = *own.maps;
    const std::vector<ShadowRefresh> refreshes = atlas.update(inWorld(list, c.mapFromWorld, atlas.lights), budget);
    if (refreshes.empty()) return;
    Frame& f = c.frame;
    osg::ref_ptr<AtlasRefresh>& refresh = f.atlasRefreshes[name];
    if (!refresh) refresh = new AtlasRefresh(name, &c.view.timer(name));
    refresh->prepare(atlas.targets(), refreshes, atlas.drawn(), atlasStates(c, name, atlas), c.timed);
    osg::ref_ptr<Pass>& pass = f.passes[name];
    if (!pass) pass = new Pass(refresh.get());
    pass->add(c.host, *own.camera, *c.view.viewport(), c.view.state(name).stateSet, *f.uniforms, cv.getProjectionMatrix(),
              cv.getModelViewMatrix());
}

}  // namespace osgEnvLight
