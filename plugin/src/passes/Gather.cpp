// SPDX-License-Identifier: MIT
#include "passes/Gather.h"

#include "passes/Inputs.h"

namespace osgEnvLight
{

bool gathers(const Settings& settings)
{
    return settings.accumulate && settings.accumulateRays > 0 && settings.bounce == Settings::BOUNCE_PROBES;
}

Requirement requireGather(const FrameContext& c)
{
    Requirement gather;
    gather.unless(!c.settings.accumulate || c.settings.accumulateRays == 0, "switched off");
    gather.unless(!c.still, "no still view is averaged");
    gather.unless(!c.indirect, "there are no probes");
    if (!gather.needed) return gather;
    const TransportScene& scene = *c.indirect->scene;
    gather.unless(scene.triangles > SceneRays::mostTriangles, "the scene has too many triangles for rays");
    gather.unless(!scene.rays, "the triangles are being made ready for rays");
    gather.unless(!c.indirect->isOfCasters || !c.skyMaps->still().noneMoves(), "something moves");
    return gather;
}

void readPathLight(PassBuilder& b, FrameContext& c, const std::string& pass)
{
    readTracedScene(b, *c.indirect);
    readProbes(b, *c.indirect);
    b.read(b.find("guides"), "guideMap");
    readSkyMaps(b, c, pass, *c.stillMaps, nullptr);
    readReceivedLight(b, c, pass, *c.stillMaps);
    if (c.facts.mapIsBlack) return;
    b.bind(c.textures->pyramid(), "pyramidMap");
    if (!c.decisions.suns.needed) return;
    b.define("HAS_SUNS");
    readSuns(b, c);
}

Requirement GatherPass::require(const FrameContext& c) const
{
    return requireGather(c).because(counted(size_t(c.settings.accumulateRays), "ray") + " a pixel in each frame of a still view");
}

void GatherPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating()) return;
    b.read(b.find("normal"), "normalMap");
    b.read(b.find("depth"), "depthMap");
    b.settings<StillViewSettings>();
    readPathLight(b, c, name());
    if (c.caustics) {
        b.define("HAS_CAUSTICS");
        b.frameUniforms(&c.frame.causticState(*c.caustics));
    }
    drawSurfaces(b);
    b.write(b.create("ray light"));
}

Requirement GatherFilterPass::require(const FrameContext& c) const
{
    return requireGather(c).because("their mean over a cell");
}

void GatherFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating()) return;
    b.readGBuffer();
    b.read(b.find("ray light"), "rayLightMap");
    if (b.read("caustics", "causticMap")) b.define("HAS_CAUSTICS");
    drawSurfaces(b);
    b.write(b.create("gathered"));
}

}  // namespace osgEnvLight
