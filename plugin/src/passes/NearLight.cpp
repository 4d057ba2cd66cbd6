// SPDX-License-Identifier: MIT
#include "passes/NearLight.h"

#include "indirect/SceneRays.h"
#include "passes/Inputs.h"
#include "passes/Links.h"

namespace osgEnvLight
{

namespace
{

// TransportScene::openShare is 0 to .07 in rooms and in courts between tall walls, .3 and more in streets and of things on a
// floor. There the rays take as much time, and what they change is little beside the map's light.
const double mostOpen = 0.2;

}  // namespace

double mostOpenForNearLight(const Settings& settings)
{
    if (settings.bounceNear == Settings::NEAR_OFF) return 0.0;
    return settings.bounceNear == Settings::NEAR_AUTO ? mostOpen : 1.0;
}

Requirement requireNearLight(const FrameContext& c)
{
    Requirement near = requireProbes(c);
    near.unless(c.settings.bounceNear == Settings::NEAR_OFF, "switched off");
    near.unless(!c.indirect, "there are no probes yet");
    if (!near.needed) return near;
    const TransportScene& scene = *c.indirect->scene;
    near.unless(scene.openShare > mostOpenForNearLight(c.settings), "surfaces hide too little of the map");
    near.unless(scene.triangles > SceneRays::mostTriangles, "the scene has too many triangles for rays");
    return near.unless(!scene.rays, "the triangles are being made ready for rays");
}

Requirement NearLightPass::require(const FrameContext& c) const
{
    return requireNearLight(c).because("a ray from each pixel to surfaces close by, which probes are too far apart to show");
}

void NearLightPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    const IndirectLight& light = *c.indirect;
    b.readGBuffer();
    readDiffuseTerms(b, c);
    b.define("HAS_LAMPS", c.facts.hasLamps());
    b.read(b.find("probe light"), "probeLightMap");
    b.settings<BounceSettings>();
    readTracedScene(b, light);
    b.bind(light.targets.cellLight, "cellLightMap");
    b.frameUniforms(light.scene->rays->uniforms);
    b.frameUniforms(light.scene->uniforms);
    b.shadowOrigin(light.scene->origin);
    drawSurfaces(b);
    b.write(b.create("near light", {GL_RGBA32F_ARB}));  // what glows beside a pixel may exceed half floats
}

Requirement NearLightFilterPass::require(const FrameContext& c) const
{
    return requireNearLight(c).because("their mean over a cell");
}

void NearLightFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    const TextureId received = b.create("indirect", ofFirstFrame(c, GL_RGBA16F_ARB));
    if (c.hasFirstFrame()) {
        b.keepContents();
        return;
    }
    b.readGBuffer();
    b.read(b.find("probe light"), "probeLightMap");
    b.read(b.find("near light"), "nearLightMap");
    if (b.read("caustics", "causticMap")) b.define("HAS_CAUSTICS");
    b.frameUniforms(&c.frame.probeState(c.indirect->share));
    drawSurfaces(b);
    b.write(received);
}

}  // namespace osgEnvLight
