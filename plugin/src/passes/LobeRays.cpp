// SPDX-License-Identifier: MIT
#include "passes/LobeRays.h"

#include "base/Limits.h"
#include "passes/Gather.h"
#include "passes/Inputs.h"
#include "passes/Specular.h"

namespace osgEnvLight
{

namespace
{

const TextureDesc exact = {GL_RGBA32F_ARB};           // places; a sun that a mirror sees exceeds half floats
const TextureDesc packedSurface = {GL_RGBA32UI_EXT};  // as in pass/loberays.frag

}  // namespace

Requirement requireLobeRays(const FrameContext& c)
{
    Requirement rays = requireLobes(c);
    rays.unless(!lobesShowScene(c), "lobes do not show the scene");
    if (rays.needed) return requireGather(c);
    return rays;
}

Requirement LobeRaysPass::require(const FrameContext& c) const
{
    return requireLobeRays(c).because("a ray in the lobe of a pixel in each frame of a still view");
}

void LobeRaysPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating()) return;
    b.readGBuffer();
    readLobes(b, c);
    b.settings<SpecularSettings>();
    b.define("HAS_AREA_LIGHTS", c.facts.areaLights > 0);
    b.define("MAP_IS_BLACK", c.facts.mapIsBlack);
    b.read(b.find("diffuse"), "diffuseTermMap");
    b.read(b.find("emission"), "emissionMap");
    if (!c.facts.mapIsBlack) {
        b.bind(c.textures->pyramid(), "pyramidMap");
        b.bind(c.textures->latlong(), "latlongMap");
        b.read(b.find("specular"), "specularTermMap");
    }
    readTracedScene(b, *c.indirect);
    b.frameUniforms(&c.frame.placeState(name(), pixelPlaces(c)));
    drawGlossy(b);
    b.write(b.create("lobe ray change", exact));
    b.write(b.create("lobe ray place", exact));
    b.write(b.create("lobe ray surface", packedSurface));
}

Requirement LobeRayLightPass::require(const FrameContext& c) const
{
    return requireLobeRays(c).because("the light of what these rays meet");
}

void LobeRayLightPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating()) return;
    b.read(b.find("lobe ray place"), "rayPlaceMap");
    b.read(b.find("lobe ray surface"), "raySurfaceMap");
    readPathLight(b, c, name());
    drawGlossy(b);
    b.write(b.create("lobe ray light", exact));
}

Requirement LobeRayFilterPass::require(const FrameContext& c) const
{
    return requireLobeRays(c).because("their mean over a cell");
}

void LobeRayFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating()) return;
    b.readGBuffer();
    readLobes(b, c);
    b.read(b.find("lobe ray change"), "rayChangeMap");
    b.read(b.find("lobe ray light"), "rayLightMap");
    drawGlossy(b);
    b.write(b.create("lobe rays", exact));
}

}  // namespace osgEnvLight
