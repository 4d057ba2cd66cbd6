// SPDX-License-Identifier: MIT
#include "passes/Specular.h"

#include "base/Limits.h"
#include "passes/Inputs.h"
#include "passes/LobeRays.h"

namespace osgEnvLight
{

Requirement requireLobes(const FrameContext& c)
{
    Requirement lobes;
    lobes.unless(!c.settings.specular, "switched off");
    // Under a black map they are there for the light of surfaces, if lamps give these any.
    const bool bounces = c.settings.bounce != Settings::BOUNCE_OFF && c.decisions.atlas.needed;
    const bool lamplit = c.facts.hasLamps() && bounces && lobesShowScene(c);
    lobes.unless(c.facts.mapIsBlack && !lamplit, "the map is black");
    lobes.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return lobes.unless(!c.facts.surfaces.hasLobes(), "no glossy surface in view");
}

namespace
{

// A still view's later frames take samples: their mean is the truth.
bool isPrefiltered(const FrameContext& c)
{
    return c.settings.specularMethod == Settings::SPECULAR_PREFILTERED && !c.hasFirstFrame();
}

// The filter averages samples.
bool isSampled(const FrameContext& c)
{
    return !isPrefiltered(c) && !c.facts.mapIsBlack;
}

std::string lookUpsOf(const FrameContext& c)
{
    return isPrefiltered(c) ? "1 look-up a pixel in the prefiltered map"
                            : counted(size_t(c.settings.specularSamples), "sample") + " a pixel";
}

// What pass/lobesamples.glsl reads, but for the suns.
void readMapOfLobes(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readLobes(b, c);
    if (c.facts.mapIsBlack) return b.define("MAP_IS_BLACK");
    b.settings<SpecularSettings>();
    if (isPrefiltered(c)) {
        b.define("PREFILTERED");
        b.bind(c.textures->prefiltered(), "prefilteredMap");
    } else {
        b.bind(c.textures->pyramid(), "pyramidMap");
    }
    b.bind(c.textures->latlong(), "latlongMap");
}

void readSunsOfLobes(PassBuilder& b, FrameContext& c)
{
    b.define("HAS_SUNS");
    readSuns(b, c);
    readSunVisibility(b);
}

Requirement requireReflections(const FrameContext& c)
{
    Requirement reflections = requireLobes(c);
    reflections.unless(c.settings.reflections < Settings::REFLECTIONS_SCREEN, "switched off");
    reflections.unless(c.settings.view != Settings::BEAUTY, "an intermediate is shown");
    return reflections.unless(!c.decisions.atlas.needed, "without the atlas nobody knows what blocks the map");
}

// What rays go through; null: none do.
const SceneRays* sceneRays(const FrameContext& c)
{
    return c.settings.reflections == Settings::REFLECTIONS_SCENE && c.indirect ? c.indirect->scene->rays.get() : nullptr;
}

// Where a ray meets nothing, nothing is in the way.
bool raysMeetAll(const FrameContext& c)
{
    return sceneRays(c) && c.indirect->isOfCasters && c.settings.view == Settings::BEAUTY && !c.facts.mapIsBlack &&
           c.skyMaps->still().areAll();
}

// What rays meet where the picture does not show it.
void readRaysOfLobes(PassBuilder& b, FrameContext& c)
{
    const bool tooMany = c.indirect && c.indirect->scene->triangles > SceneRays::mostTriangles;
    if (tooMany && c.settings.reflections == Settings::REFLECTIONS_SCENE) c.remark(", no rays through so many triangles");
    if (!sceneRays(c)) return;
    b.define("HAS_SCENE_RAYS");
    b.define("RAYS_MEET_ALL", raysMeetAll(c));
    readTracedScene(b, *c.indirect);
    b.bind(c.indirect->targets.cellLight, "cellLightMap");
    b.frameUniforms(sceneRays(c)->uniforms);
    b.shadowOrigin(c.indirect->scene->origin);
    b.frameUniforms(&c.frame.probeState(c.indirect->share));
    b.read(b.find("specular"), "specularTermMap");
    b.read("coat", "coatTermMap");
    b.read(b.find("blocked lobe"), "blockedLobeMap");
    b.read("blocked coat", "blockedCoatMap");
    c.remark(", else what rays through the scene meet");
}

const TextureDesc sums = {GL_RGBA32F_ARB};          // radiance of a mirrored sun exceeds half floats in units of the map's mean
const TextureDesc packedLobes = {GL_RGBA32UI_EXT};  // as in pass/lobesums.glsl

}  // namespace

Requirement SpecularPass::require(const FrameContext& c) const
{
    return requireLobes(c).unless(c.facts.mapIsBlack, "the map is black").because(lookUpsOf(c));
}

void SpecularPass::setup(PassBuilder& b, FrameContext& c)
{
    readMapOfLobes(b, c);
    drawGlossy(b);
    b.write(b.create("lobe estimate", sums));
    if (b.find("lobe lights").valid()) c.remark(", occluded by what the atlas knows");
    if (!c.decisions.suns.needed) return;
    readSunsOfLobes(b, c);
    b.write(b.create("sun glint", sums));
}

Requirement LobeRowsPass::require(const FrameContext& c) const
{
    return requireLobes(c).because("averages the samples of a cell along rows");
}

void LobeRowsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame() || (!isSampled(c) && !b.find("lobe lights").valid())) return;
    b.readGBuffer();
    b.settings<FilterSettings>();
    drawGlossy(b);
    b.define("PREFILTERED", !isSampled(c));
    if (isSampled(c)) {
        b.read(b.find("lobe estimate"), "estimateMap");
        b.write(b.create("row estimate", sums));
    }
    if (!b.read("lobe lights", "lobeLightMap")) return;
    b.define("HAS_LOBE_LIGHTS");
    b.write(b.create("row lobe lights", packedLobes));
}

Requirement CoatPass::require(const FrameContext& c) const
{
    Requirement coat = requireLobes(c);
    coat.unless(!c.facts.surfaces.hasCoats(), "no clear coat in view");
    return coat.because(c.facts.mapIsBlack ? "what hides a black map" : lookUpsOf(c));
}

void CoatPass::setup(PassBuilder& b, FrameContext& c)
{
    readMapOfLobes(b, c);
    b.drawMarked(b.find("pixel marks"), limits::MARK_COATED);
    b.write(b.create("coat", sums));
    if (c.decisions.suns.needed) readSunsOfLobes(b, c);
    // Rays say what the scene hides of the map in a still view.
    if (!b.find("lobe lights").valid() || (c.hasFirstFrame() && requireLobeRays(c).needed)) return;
    b.define("HAS_LOBE_LIGHTS");
    b.define("HAS_ATLAS");
    readSkyMaps(b, c, "atlas", *c.skyMaps, c.nearSkyMaps);
    b.bind(c.atlasLights.nearest("atlas", *c.skyMaps), "nearestLightMap");
    b.write(b.create("blocked coat"));
}

Requirement LobesPass::require(const FrameContext& c) const
{
    return requireLobes(c).because("averages the samples of a cell, the rows along columns");
}

void LobesPass::setup(PassBuilder& b, FrameContext& c)
{
    const bool sampled = isSampled(c);
    const bool sharp = c.hasFirstFrame() || (!sampled && !b.find("lobe lights").valid());
    b.readGBuffer();
    b.settings<FilterSettings>();
    readLobes(b, c);
    b.define("LOBES_SHARP", sharp);
    b.define("PREFILTERED", !sampled);
    b.define("MAP_IS_BLACK", c.facts.mapIsBlack);
    if (!c.facts.mapIsBlack) b.read(b.find(sharp || !sampled ? "lobe estimate" : "row estimate"), "estimateMap");
    if (b.read("sun glint", "sunGlintMap")) b.define("HAS_SUNS");
    b.read("coat", "coatTermMap");
    drawGlossy(b);
    b.write(b.create("specular", sums));
    if (!b.find("lobe lights").valid()) return;
    const TextureId blocked = b.create("blocked lobe", ofFirstFrame(c, GL_RGBA16F_ARB));
    const TextureId shown = c.still ? b.create("lobe shown", ofFirstFrame(c, GL_RGBA16F_ARB)) : TextureId();
    if (sharp) {
        b.define("HAS_SHOWN");
        b.read(shown, "shownMap");
        return;
    }
    b.read(b.find("row lobe lights"), "lobeLightMap");
    b.define("HAS_LOBE_LIGHTS");
    b.write(blocked);
    if (raysMeetAll(c)) {
        b.define("KEEPS_HIDDEN");
        b.write(b.create("hidden lobe"));
    }
    if (!c.still) return;
    b.define("KEEPS_SHOWN");
    b.write(shown);
}

Requirement ReflectionsPass::require(const FrameContext& c) const
{
    return requireReflections(c).because("what the picture shows in the way, " +
                                         counted(size_t(c.settings.reflectionSteps), "point") + " a ray");
}

void ReflectionsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame() || !b.find("blocked lobe").valid()) return;
    b.readGBuffer();
    b.settings<SpecularSettings>();
    readLobes(b, c);
    b.read(b.find("radiance"), "radianceMap");
    if (c.facts.areaLights > 0) {
        b.define("HAS_AREA_LIGHTS");
        b.read("emission", "emissionMap");
    }
    readRaysOfLobes(b, c);
    b.drawMarked(b.find("pixel marks"), limits::MARK_TRACED);
    b.write(b.create("reflection", {GL_RGBA32F_ARB}));
}

Requirement ReflectionFilterPass::require(const FrameContext& c) const
{
    return requireReflections(c).because("their mean over a cell");
}

void ReflectionFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.still && b.find("blocked lobe").valid()) b.create("reflected", ofFirstFrame(c, GL_RGBA32F_ARB));
    if (c.hasFirstFrame()) b.keepContents();
    if (!b.find("reflection").valid()) return;
    b.readGBuffer();
    readLobes(b, c);
    b.read(b.find("reflection"), "reflectionMap");
    b.read(b.find("specular"), "specularTermMap");
    b.read(b.find("blocked lobe"), "blockedLobeMap");
    if (b.read("hidden lobe", "hiddenLobeMap")) b.define("RAYS_MEET_ALL");
    b.read("coat", "coatTermMap");
    b.read("blocked coat", "blockedCoatMap");
    if (b.read("mirrored", "mirroredMap"))
        b.define("HAS_PROBES");
    else
        b.define("HAS_BOUNCE", b.read("bounce", "bounceMap"));
    if (readFog(b, c)) b.read(b.find("emission"), "emissionMap");
    b.drawMarked(b.find("pixel marks"), c.still ? limits::MARK_GLOSSY : limits::MARK_TRACED);
    b.addLaterTo(b.find("radiance"));
    if (!c.still) return;
    b.define("KEEPS_REFLECTED");
    b.write(b.find("reflected"));
}

}  // namespace osgEnvLight
