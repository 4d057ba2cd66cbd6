// SPDX-License-Identifier: MIT
// How shadow maps are drawn in a frame, the sky's and the suns'.
#include "node/DeferredTechnique.h"

#include <osg/ColorMask>
#include <osg/Depth>
#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

namespace
{

const unsigned on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

}  // namespace

AtlasRefresh::States DeferredTechnique::mapStates(Cull& c, const std::string& name, const std::string& shader,
                                                  const ShadowTargets& targets)
{
    AtlasRefresh::States states;
    for (const bool second : {false, true}) {
        ViewData::State state =
            c.view.state({name + (second ? " casters second" : " casters first"), {}, {targets.firstDepth.get()}});
        osg::StateSet& s = state.stateSet;
        (second ? states.second : states.first) = &s;
        if (!state.isNew) continue;
        s.setAttribute(_library->program("pass/caster.vert", "pass/caster.frag"), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), on);
        s.setMode(GL_DEPTH_CLAMP, on);  // what lies above a map's heights casts shadows into it
        s.addUniform(new osg::Uniform("baseColorMap", 0));
        if (!second) continue;
        s.setDefine("CASTER_SECOND");
        s.setAttribute(new osg::ColorMask(false, true, false, false), on);  // beside the first one's slope
        bind(s, 1, {"firstDepthMap", targets.firstDepth.get()});
    }
    ViewData::State state = c.view.state({name + " maps", {}, {targets.firstDepth.get()}});
    states.midpoints = &state.stateSet;
    if (state.isNew) {
        osg::StateSet& s = state.stateSet;
        s.setAttribute(_library->program("pass/fullscreen.vert", shader), on);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false), osg::StateAttribute::OFF);
        bind(s, 0, {"firstDepthMap", targets.firstDepth.get()});
        bind(s, 1, {"secondDepthMap", targets.secondDepth.get()});
        bind(s, 2, {"firstSlopeMap", targets.firstSlope.get()});
    }
    return states;
}

void DeferredTechnique::addRefresh(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, const std::string& shader,
                                   osg::Camera& camera, const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes,
                                   std::vector<Caster>&& casters)
{
    Frame& f = c.frame;
    osg::ref_ptr<AtlasRefresh>& refresh = f.atlasRefreshes[name];
    if (!refresh) refresh = new AtlasRefresh(name, &c.view.timer(name), c.frame.triangle.get());
    refresh->prepare(targets, refreshes, std::move(casters), mapStates(c, name, shader, targets), c.timed);
    osg::ref_ptr<Pass>& pass = f.passes[name];
    if (!pass) pass = new Pass(refresh.get());
    pass->add(c.host, camera, *c.view.viewport(), c.view.state({name}).stateSet, *f.uniforms, cv.getProjectionMatrix(),
              cv.getModelViewMatrix());
}

}  // namespace osgEnvLight
