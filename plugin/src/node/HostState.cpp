// SPDX-License-Identifier: MIT
#include "node/HostState.h"

#include "surface/AreaLightPlace.h"
#include "surface/Backdrop.h"

#include <osg/Camera>
#include <osg/GraphicsContext>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgEnvLight
{

namespace
{

bool overlaps(const osg::Viewport* a, const osg::Viewport* b)
{
    return a && b && a->x() < b->x() + b->width() && b->x() < a->x() + a->width() && a->y() < b->y() + b->height() &&
           b->y() < a->y() + a->height();
}

// A camera before the host's has cleared these colours and drawn into them: the far part of a depth partition, a backdrop.
bool drawsOverAnother(const osg::Camera* host)
{
    const osg::GraphicsContext* context = host ? host->getGraphicsContext() : nullptr;
    if (!context || (host->getClearMask() & GL_COLOR_BUFFER_BIT)) return false;
    for (const osg::Camera* other : const_cast<osg::GraphicsContext*>(context)->getCameras()) {
        const bool before = std::make_pair(other->getRenderOrder(), other->getRenderOrderNum()) <=
                            std::make_pair(host->getRenderOrder(), host->getRenderOrderNum());
        if (other != host && before && (other->getClearMask() & GL_COLOR_BUFFER_BIT) && other->getBufferAttachmentMap().empty() &&
            host->getBufferAttachmentMap().empty() && overlaps(other->getViewport(), host->getViewport()))
            return true;
    }
    return false;
}

// The host clears to the fog's colour: what is far goes over into it.
bool endsInFog(const FrameContext& c)
{
    if (c.fog.kind == 0 || !(c.host.getClearMask() & GL_COLOR_BUFFER_BIT)) return false;
    const osg::Vec4& cleared = c.host.getClearColor();
    float most = 0.0f;
    for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(cleared[unsigned(i)] - c.fog.color[i]));
    return most < 1.0f / 255.0f;
}

std::string describeBackground(FrameContext& c, const std::vector<ForwardGraph>& forward)
{
    c.background = c.settings.background;
    if (c.background == Settings::BACKGROUND_AUTO) {
        const std::string backdrop = findBackdrop(c.host, forward);
        const bool fog = endsInFog(c);
        c.background = backdrop.empty() && !fog ? Settings::BACKGROUND_ON : Settings::BACKGROUND_OFF;
        if (!backdrop.empty()) return backdrop + " behind";
        if (fog) return "the fog's colour behind, to which the host clears";
    }
    if (c.background == Settings::BACKGROUND_OFF) return "the background switched off";
    const bool keepsColors = c.settings.background == Settings::BACKGROUND_AUTO && !(c.host.getClearMask() & GL_COLOR_BUFFER_BIT);
    if (keepsColors || drawsOverAnother(c.host.getCamera())) {
        c.background = Settings::BACKGROUND_OFF;
        return "the colours behind that the host does not clear";
    }
    return c.background == Settings::BACKGROUND_BLUR ? "the map behind, blurred" : "the map behind";
}

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

}  // namespace

void chooseBackground(FrameContext& c, const std::vector<ForwardGraph>& forward)
{
    c.behind = describeBackground(c, forward);
}

// Where only the view has moved they stay the same to the bit, and so do the textures made of them.
void findAreaLights(FrameContext& c, ViewData& data, const std::function<void(const std::string&)>& report)
{
    std::vector<std::string> problems;
    c.areaLights = takeEmitters(c.host, c.worldFromEye, &problems);
    const auto isRounded = [](const Emitter& a, const Emitter& b) { return a.isRounded(b); };
    const std::vector<Emitter>& former = data.areaLights;
    if (std::equal(c.areaLights.begin(), c.areaLights.end(), former.begin(), former.end(), isRounded)) c.areaLights = former;
    data.areaLights = c.areaLights;
    for (const std::string& problem : problems) report(problem + "; it is left out");
    c.facts.areaLights = c.areaLights.size();
}

namespace
{

bool showsSomething(const FrameContext& c)
{
    return c.facts.surfaces.deferred + c.facts.surfaces.litForward > 0;
}

bool sendsOn(const FrameContext& c)
{
    return c.facts.hasLamps() && c.settings.bounce != Settings::BOUNCE_OFF;
}

// What moves is shown where it was in the frame before.
bool averages(const FrameContext& c)
{
    return Decisions::wantsAverage(c.settings) && c.facts.surfaces.deferred > 0;
}

bool asksForCasters(const FrameContext& c, bool sunny)
{
    if (averages(c) || (needsCarrier(c) && Decisions::wantsAtlas(c.settings))) return true;
    const bool hasLamps = !c.areaLights.empty() || (c.settings.sceneLightShadows && castShadows(c.lights));
    return (sunny || (hasLamps && Decisions::wantsEmitterMaps(c.settings))) && showsSomething(c);
}

// Lamps outside of the view light it, too. They are among the casters. If no pass asks for the casters, the search is worth it
// when the view shows a lamp, when the frame before had one, or when the map is black.
bool mayHaveLamps(const FrameContext& c, const ViewData& data)
{
    return c.lampRule().finds && showsSomething(c) &&
           (c.facts.mapIsBlack || c.facts.surfaces.lamps > 0 || !data.meshLights.empty());
}

void addMeshLights(FrameContext& c, ViewData& data, const std::function<void(const std::string&)>& report)
{
    const size_t most = 4096;
    if (c.casters.lamps == 0) return data.meshLights.clear();
    std::vector<Emitter> lights = data.meshLights.of(c.casters.all, c.emittedScale(), 1e-6 * c.facts.sceneRadius);
    if (lights.size() > most) {
        report(std::to_string(lights.size()) + " meshes glow; the " + std::to_string(most) + " that send most are lights");
        const auto sendsMore = [](const Emitter& a, const Emitter& b) { return a.flux() > b.flux(); };
        std::nth_element(lights.begin(), lights.begin() + most, lights.end(), sendsMore);
        lights.resize(most);
    }
    c.areaLights.insert(c.areaLights.end(), lights.begin(), lights.end());
    c.facts.areaLights = c.areaLights.size();
}

void collectCasters(const FrameContext& c, ViewData& data, osg::Group& node, SurfaceFacts& facts)
{
    CasterCollector collector(c.cv, c.worldFromEye, data.casterStates, &facts);
    collector.findLamps(c.lampRule());
    if (c.settings.bounce == Settings::BOUNCE_PROBES) collector.findSentLight(c.settings.materialColors == Settings::COLORS_SRGB);
    collector.collect(node, data.casters);
}

}  // namespace

bool needsCarrier(const FrameContext& c)
{
    return c.settings.diffuse && (!c.facts.mapIsBlack || sendsOn(c)) && showsSomething(c);
}

void placeGround(FrameContext& c, ViewData& data, osg::Group& node, SurfaceFacts& facts)
{
    if (c.settings.ground == Settings::GROUND_OFF || !c.facts.ownGBuffer) return data.ground.clear();
    collectCasters(c, data, node, facts);
    data.ground.update(data.casters);
    if (data.ground.geometry()) c.ground = &data.ground;
}

void findCasters(FrameContext& c, ViewData& data, osg::Group& node, SurfaceFacts& facts, bool sunny,
                 const std::function<void(const std::string&)>& report)
{
    if (asksForCasters(c, sunny) || mayHaveLamps(c, data)) {
        if (!c.ground) collectCasters(c, data, node, facts);  // else placeGround() has done so
        addMeshLights(c, data, report);
    } else {
        data.meshLights.clear();
        data.casters.clear();
    }
    if (averages(c))
        c.moved = data.casterMotion.update(c.casters.all, osg::Vec3d() * c.worldFromEye);
    else
        data.casterMotion.forget();
    c.facts.casters = c.casters.all.size();
    c.showsNothing = !showsSomething(c) && c.facts.sceneRadius > 0.0;
    if (!c.showsNothing) CasterCollector::forgetUnused(data.casterStates, c.casters.all);
}

// A LightSource that comes after the node in the graph is met after the node's cull. So the frame before says that there is one,
// and the end of this frame's cull says what it is like.
void findLights(FrameContext& c, ViewData& data, const std::vector<ForwardGraph>& forward,
                const std::function<void(const std::string&)>& report)
{
    if (c.settings.sceneLights == Settings::SCENE_LIGHTS_OFF || !c.facts.ownGBuffer) {
        data.lateLights.clear();
        if (c.frame.gbufferStage) c.frame.gbufferStage->afterCull = nullptr;
        return;
    }
    const bool withView = c.settings.sceneLights == Settings::SCENE_LIGHTS_ON;
    const osg::View* view = c.host.getCamera() ? c.host.getCamera()->getView() : nullptr;
    const SceneLightList known = findSceneLights(c.host, view, withView);
    SceneLightList expected = known;
    for (const SceneLight& late : without(data.lateLights, known)) expected.push_back(late);
    LightModes modes;
    if (!expected.empty()) modes = findLightModes(*c.frame.gbufferStage, forward);
    c.lights = switchedOn(expected, modes.some);
    for (const SceneLight& l : switchedOn(c.lights, ~modes.all))
        report("light " + l.name + " is switched on for some of the surfaces only, and lights all of them");
    c.facts.sceneLights = c.lights.size();
    // All that this refers to lives as long as the cull.
    c.frame.gbufferStage->afterCull = [=, host = &c.host, frame = &c.frame, data = &data] {
        const SceneLightList all = findSceneLights(*host, view, withView);
        frame->sceneLights.set(switchedOn(all, modes.some));
        data->lateLights = without(all, known);  // shown by the frame that follows (LitScene::followFrame)
    };
}

}  // namespace osgEnvLight
