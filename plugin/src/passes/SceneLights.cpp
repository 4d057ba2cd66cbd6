// SPDX-License-Identifier: MIT
#include "passes/SceneLights.h"

#include "passes/Inputs.h"
#include "shadow/SceneLightPoints.h"

namespace osgEnvLight
{

namespace
{

Requirement requireSceneLights(const FrameContext& c)
{
    const size_t count = c.facts.sceneLights;
    Requirement lights;
    lights.unless(c.settings.sceneLights == Settings::SCENE_LIGHTS_OFF, "switched off");
    lights.unless(!c.facts.ownGBuffer, "the application's own G-buffer says what surfaces emit");
    lights.unless(count == 0 && c.settings.sceneLights == Settings::SCENE_LIGHTS_AUTO, "only the viewer's own light");
    return lights.unless(count == 0, "no light is switched on");
}

}  // namespace

Requirement SceneLightMapsPass::require(const FrameContext& c) const
{
    Requirement maps = requireSceneLights(c);
    maps.unless(!c.settings.sceneLightShadows, "sceneLightShadows is off");
    maps.unless(!castShadows(c.lights), "only the viewer's own light");
    const std::string side = std::to_string(c.settings.sceneLightMapSize);
    return requireEmitterMaps(c, maps).because("maps of " + side + " x " + side + " of " + counted(c.facts.casters, "drawable") +
                                               ", from " + counted(c.facts.sceneLights, "light"));
}

void SceneLightMapsPass::update(FrameContext& c)
{
    const osg::BoundingBoxd& box = c.casters.bound;
    SceneLightFaces faces;
    std::vector<EmitterPoint> points = sceneLightPoints(c.lights, c.worldFromEye, box, faces);
    if (!areRounded(points, _points, box, c.worldFromEye.getTrans())) _points = std::move(points);
    c.sceneLightMaps = &_maps.update(c, _points, unsigned(c.settings.sceneLightMapSize));
    c.sceneLightPoints = _maps.points();
    c.frame.sceneLights.faces = faces;
}

void SceneLightMapsPass::setup(PassBuilder& b, FrameContext& c)
{
    c.remark(", " + std::to_string(_points.size()) + " in all");
    _maps.draw(b, c, name(), name());
}

void SceneLightMapsPass::dismiss(FrameContext& c)
{
    c.frame.sceneLights.faces = {};
    if (c.showsNothing && c.facts.sceneLights > 0 && Decisions::wantsEmitterMaps(c.settings)) return;
    _maps.drop();
    _points.clear();
}

Requirement SceneLightsPass::require(const FrameContext& c) const
{
    Requirement lights = requireSceneLights(c);
    lights.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return lights.because(counted(c.facts.sceneLights, "light") + (c.sceneLightMaps ? "" : ", without shadows"));
}

void SceneLightsPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readLobes(b, c);
    drawSurfaces(b);
    if (c.sceneLightMaps) {
        b.define("HAS_SCENE_LIGHT_MAPS");
        readSceneLightMaps(b, c);
        b.shadowOrigin(c.sceneLightMaps->origin());
    }
    b.frameUniforms(&c.frame.sceneLightState());
    b.settings<SurfaceSettings>();
    b.addTo(b.find("emission"));
}

}  // namespace osgEnvLight
