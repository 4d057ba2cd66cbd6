// SPDX-License-Identifier: MIT
#include "passes/Occlusion.h"

#include "base/Limits.h"
#include "passes/Inputs.h"

namespace osgEnvLight
{

namespace
{

Requirement requireBounce(const FrameContext& c)
{
    Requirement bounce;
    bounce.unless(c.settings.bounce == Settings::BOUNCE_OFF, "switched off");
    bounce.unless(c.indirect && c.indirect->share >= 1.0, "probes know it");
    bounce.unless(!c.decisions.occlusion.needed, "no light is blocked");
    return bounce.unless(!c.decisions.atlas.needed, "without the atlas nobody knows how much of the map a surface sees");
}

// S is occluded by what the atlas knows.
bool occludesLobes(const FrameContext& c)
{
    const Settings& s = c.settings;
    return c.decisions.atlas.needed && s.specular && s.reflections != Settings::REFLECTIONS_OFF && c.facts.surfaces.hasLobes();
}

void readLights(PassBuilder& b, FrameContext& c)
{
    b.settings<OcclusionSettings>();
    if (c.decisions.atlas.needed) {
        b.define("HAS_ATLAS");
        readSkyMaps(b, c, "atlas", *c.skyMaps, c.nearSkyMaps);
    } else {
        b.bind(c.textures->occlusionLights(c.decisions.occlusionLights), "occlusionLightMap");
    }
    // Beside the atlas it is slices, whatever the method of the screen alone.
    static const char* const methods[] = {"OCCLUSION_SLICES", "OCCLUSION_RAYS", "OCCLUSION_POINTS", "OCCLUSION_HORIZONS",
                                          "OCCLUSION_BENT_NORMAL"};
    if (!c.decisions.screen) return;
    b.define(methods[c.decisions.atlas.needed ? Settings::SLICE : c.settings.occlusionMethod]);
    const int slices = c.decisions.atlas.needed ? c.settings.nearSlices : c.settings.occlusionSlices;
    if (slices < 4) b.define("SLICES_" + std::to_string(slices));
}

const TextureDesc packed = {GL_RGBA32UI_EXT};  // as in pass/lightsums.glsl
using Texel = std::array<float, 4>;
const Texel noSums = {0, 0, 0, 0};
const Texel noPlace = {0, 0, 1, 0};  // the depth of the background

}  // namespace

void writeSums(PassBuilder& b, const char* sums, const char* places)
{
    b.write(b.create(sums, packed), noSums);
    b.write(b.create(places, packed), noPlace);
}

void filterRows(PassBuilder& b, const char* sums, const char* places, const char* rowSums, const char* rowPlaces)
{
    b.readGBuffer();
    b.read(b.find(sums), "sumsMap");
    b.read(b.find(places), "placeMap");
    drawSurfaces(b);
    writeSums(b, rowSums, rowPlaces);
}

void filterColumns(PassBuilder& b, const char* rowSums, const char* rowPlaces, TextureId result, float elsewhere)
{
    b.readGBuffer();
    b.read(b.find(rowSums), "sumsMap");
    b.read(b.find(rowPlaces), "placeMap");
    drawSurfaces(b);
    b.write(result, {elsewhere, elsewhere, elsewhere, elsewhere});
}

Requirement OcclusionPass::require(const FrameContext& c) const
{
    return c.decisions.occlusion;
}

void OcclusionPass::setup(PassBuilder& b, FrameContext& c)
{
    b.read("normal", "normalMap");
    b.read("depth", "depthMap");
    readLights(b, c);
    if (occludesLobes(c))
        b.drawOnly(b.find("pixel marks"), limits::MARK_SURFACE);
    else
        drawSurfaces(b);
    writeSums(b, "light sums", "light places");
}

Requirement GlossyOcclusionPass::require(const FrameContext& c) const
{
    Requirement glossy = c.decisions.occlusion;
    glossy.unless(!occludesLobes(c), "no lobe is asked what hides the map from it");
    return glossy.because("surfaces with a lobe ask for its lights, too");
}

void GlossyOcclusionPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readLights(b, c);
    b.define("HAS_LOBES");
    readLobes(b, c);
    b.bind(c.atlasLights.nearest("atlas", *c.skyMaps), "nearestLightMap");
    b.drawMarked(b.find("pixel marks"), limits::MARK_GLOSSY);
    b.drawOver(b.find("light sums"));
    b.drawOver(b.find("light places"));
    b.write(b.create("lobe lights", packed), noSums);
}

Requirement FilterRowsPass::require(const FrameContext& c) const
{
    Requirement filter = c.decisions.occlusion;
    return filter.because("averages the 16 groups of lights along rows");
}

void FilterRowsPass::setup(PassBuilder& b, FrameContext& c)
{
    b.settings<FilterSettings>();
    b.define("COMBINE_SUBTRACT", c.settings.combine == Settings::SUBTRACT);
    filterRows(b, "light sums", "light places", "row sums", "row places");
}

Requirement FilterPass::require(const FrameContext& c) const
{
    Requirement filter = c.decisions.occlusion;
    return filter.because("averages the 16 groups of lights, the rows along columns");
}

void FilterPass::setup(PassBuilder& b, FrameContext& c)
{
    b.settings<FilterSettings>();
    b.define("COMBINE_SUBTRACT", c.settings.combine == Settings::SUBTRACT);
    filterColumns(b, "row sums", "row places", b.create("occlusion", ofFirstFrame(c, GL_RGBA16F_ARB)));
    if (c.hasFirstFrame()) b.keepContents();
}

Requirement BouncePass::require(const FrameContext& c) const
{
    return requireBounce(c).because("mean radiance of the picture where light is blocked");
}

void BouncePass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readDiffuseTerms(b, c);
    for (const char* name : {"bounce plain", "bounce x", "bounce y", "bounce z", "bounce sent"})
        b.write(b.create(name, {GL_RGBA32F_ARB, limits::BOUNCE_BLOCKS}));
}

Requirement BounceSumPass::require(const FrameContext& c) const
{
    return requireBounce(c).because("the sum of its blocks");
}

void BounceSumPass::setup(PassBuilder& b, FrameContext& c)
{
    b.read(b.find("bounce plain"), "plainMap");
    b.read(b.find("bounce x"), "alongXMap");
    b.read(b.find("bounce y"), "alongYMap");
    b.read(b.find("bounce z"), "alongZMap");
    b.read(b.find("bounce sent"), "sentOnMap");
    const int sums = 8;  // five are used
    b.write(b.create("bounce", ofFirstFrame(c, GL_RGBA32F_ARB, sums)));
    if (c.hasFirstFrame()) b.keepContents();
}

}  // namespace osgEnvLight
