// SPDX-License-Identifier: MIT
#include "passes/Lighting.h"

#include "base/Limits.h"
#include "passes/Inputs.h"

namespace osgEnvLight
{

Requirement SceneLightsPass::require(const FrameContext& c) const
{
    const size_t count = c.facts.sceneLights;
    Requirement lights;
    lights.unless(c.settings.sceneLights == Settings::SCENE_LIGHTS_OFF, "switched off");
    lights.unless(!c.facts.ownGBuffer, "the application's own G-buffer says what surfaces emit");
    lights.unless(count == 0 && c.settings.sceneLights == Settings::SCENE_LIGHTS_AUTO, "only the viewer's own light");
    lights.unless(count == 0, "no light is switched on");
    lights.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return lights.because(counted(count, "light") + ", without shadows");
}

void SceneLightsPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readLobes(b, c);
    drawSurfaces(b);
    b.frameUniforms(&c.frame.sceneLightState());
    b.settings<SurfaceSettings>();
    b.addTo(b.find("emission"));
}

Requirement DiffusePass::require(const FrameContext& c) const
{
    Requirement diffuse = c.decisions.light;
    diffuse.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return diffuse.because(c.facts.carrier.describe());
}

void DiffusePass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readIrradiance(b, c);
    readLobes(b, c);
    drawSurfaces(b);
    b.write(b.create("diffuse"));
    if (!c.decisions.sunDiffuse) return;
    b.define("HAS_SUNS");
    readSuns(b, c);
    b.write(b.create("sun diffuse"));
    if (readSunVisibility(b)) b.write(b.create("sun shaded"));
}

}  // namespace osgEnvLight
