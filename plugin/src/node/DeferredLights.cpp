// SPDX-License-Identifier: MIT
// The application's lights: which count, and the pass that adds what surfaces reflect of them.
#include "node/DeferredTechnique.h"

#include <osg/Camera>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

bool has(const SceneLightList& lights, unsigned number)
{
    return std::any_of(lights.begin(), lights.end(), [&](const SceneLight& l) { return l.number == number; });
}

SceneLightList without(SceneLightList lights, const SceneLightList& others)
{
    const auto known = [&](const SceneLight& l) { return has(others, l.number); };
    lights.erase(std::remove_if(lights.begin(), lights.end(), known), lights.end());
    return lights;
}

SceneLightList switchedOn(SceneLightList lights, unsigned modes)
{
    const auto off = [&](const SceneLight& l) { return !(modes >> l.number & 1); };
    lights.erase(std::remove_if(lights.begin(), lights.end(), off), lights.end());
    return lights;
}

}  // namespace

// The light of a LightSource behind the node in the graph is known only after the cull: that there is one, the frame before says,
// what it is like, the end of this one's.
void DeferredTechnique::findLights(Cull& c, const std::vector<ForwardGraph>& forward)
{
    if (c.settings.sceneLights == Settings::SCENE_LIGHTS_OFF || !c.ownGBuffer) {
        c.view.lateLights.clear();
        c.frame.gbufferStage->afterCull = nullptr;
        return;
    }
    const bool withView = c.settings.sceneLights == Settings::SCENE_LIGHTS_ON;
    const osg::View* view = c.host.getCamera() ? c.host.getCamera()->getView() : nullptr;
    const SceneLightList known = findSceneLights(c.host, view, withView);
    SceneLightList expected = known;
    for (const SceneLight& late : without(c.view.lateLights, known)) expected.push_back(late);
    LightModes modes;
    if (!expected.empty()) modes = findLightModes(*c.frame.gbufferStage, forward);
    c.lights = switchedOn(expected, modes.some);
    for (const SceneLight& l : switchedOn(c.lights, ~modes.all)) {
        std::lock_guard<std::mutex> lock(_mutex);
        reportOnce("light " + l.name + " is switched on for some of the surfaces only, and lights all of them", osg::NOTICE);
    }
    // All that this refers to lives as long as the cull.
    c.frame.gbufferStage->afterCull = [=, host = &c.host, frame = &c.frame, data = &c.view] {
        const SceneLightList all = findSceneLights(*host, view, withView);
        frame->sceneLights.set(switchedOn(all, modes.some));
        data->lateLights = without(all, known);  // shown by the frame that follows (LitScene::followFrame)
    };
}

// In a frame without a G-buffer: a light behind the node in the graph is heard of only by a stage that the host has, here empty.
void DeferredTechnique::awaitLights(Cull& c)
{
    GBufferStage& stage = *c.frame.gbufferStage;
    if (!stage.afterCull) return;
    stage.getStateGraphList().clear();
    stage.getRenderBinList().clear();
    stage.setPositionalStateContainer(nullptr);  // the host's, which is not to be drawn twice
    stage.setCamera(nullptr);
    stage.setClearMask(0);
    c.host.addPreRenderStage(&stage, 0);
}

Target& DeferredTechnique::lightTarget(Cull& c)
{
    Target& target = c.view.target("scenelights", {});
    if (!target.frameBuffer->hasAttachment(osg::Camera::COLOR_BUFFER0))
        target.frameBuffer->setAttachment(osg::Camera::COLOR_BUFFER0, osg::FrameBufferAttachment(c.gbuffer.emission.get()));
    return target;
}

void DeferredTechnique::addSceneLights(Cull& c, osgUtil::CullVisitor& cv, Target& target)
{
    PassInputs in;
    in.adds = true;
    addLobes(c, in);
    addPass(c, cv, "scenelights", target, passState(c, "scenelights", in), {&c.frame.sceneLightState(), osg::Vec3d()});
}

}  // namespace osgEnvLight
