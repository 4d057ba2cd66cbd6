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

Requirement SpecularPass::require(const FrameContext& c) const
{
    Requirement specular;
    specular.unless(!c.settings.specular, "switched off").unless(c.facts.mapIsBlack, "the map is black");
    specular.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    specular.unless(!c.facts.surfaces.hasLobes(), "no glossy surface in view");
    return specular.because(counted(size_t(c.settings.specularSamples), "sample") + " a pixel");
}

void SpecularPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    b.settings<SpecularSettings>();
    b.bind(c.textures.pyramid(), "pyramidMap");
    b.bind(c.textures.latlong(), "latlongMap");
    readLobes(b, c);
    if (c.decisions.suns.needed) {
        b.define("HAS_SUNS");
        readSuns(b, c);
    }
    readSunVisibility(b);
    b.drawMarked(b.find("pixel marks"), limits::MARK_GLOSSY);
    b.write(b.create("specular", {GL_RGBA32F_ARB}));  // a mirrored sun exceeds half floats in units of the map's mean
    if (!b.read("lobe visibility", "lobeSeenMap")) return;
    c.remark(", occluded by what the atlas knows");
    b.define("HAS_LOBES");
    b.define("LOBES_UNOCCLUDED", c.isAccumulating());
    b.write(b.create("blocked lobe"));
}

}  // namespace osgEnvLight
