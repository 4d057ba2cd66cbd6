// SPDX-License-Identifier: MIT
#include "passes/Output.h"

#include "passes/Inputs.h"

namespace osgEnvLight
{

namespace
{

Requirement requirePicture(const FrameContext& c)
{
    Requirement picture;
    return picture.unless(c.settings.view != Settings::BEAUTY, "an intermediate is shown");
}

// What display() multiplies by. Returns whether unlit pixels have another exposure than the rest.
bool readExposure(PassBuilder& b, const FrameContext& c)
{
    b.settings<OutputSettings>();
    if (!c.adaptedStops.valid()) return false;
    b.define("ADAPTED");
    b.read(c.adaptedStops, "adaptedStopsMap");
    b.define("HAS_UNLIT", c.facts.surfaces.unlit > 0);
    return c.facts.surfaces.unlit > 0;
}

// The frame's radiance, and a still view's average.
bool readShown(PassBuilder& b, const FrameContext& c)
{
    if (!b.read("radiance", "radianceMap")) return false;
    if (!c.hasFirstFrame()) return true;
    b.define("ACCUMULATED");
    b.read(b.find("average"), "accumulatedMap");
    return true;
}

}  // namespace

Requirement BackgroundPass::require(const FrameContext& c) const
{
    Requirement background = requirePicture(c);
    background.unless(c.background == Settings::BACKGROUND_OFF, c.behind);
    return background.because(c.behind);
}

// A still view shows its first frame's while its average is young.
void BackgroundPass::setup(PassBuilder& b, FrameContext& c)
{
    const TextureId radiance = b.create("radiance", ofFirstFrame(c, GL_RGBA32F_ARB));
    if (c.hasFirstFrame()) {
        b.keepContents();
        return;
    }
    readBackground(b, c);
    if (b.find("pixel marks").valid()) b.drawUnmarked(b.find("pixel marks"));
    b.write(radiance);
}

Requirement ResolvePass::require(const FrameContext& c) const
{
    return requirePicture(c).because(c.fog.kind == 0 ? "the sum of the terms" : "the sum of the terms, through the fog");
}

void ResolvePass::setup(PassBuilder& b, FrameContext& c)
{
    TextureId radiance = b.find("radiance");
    const bool overBackground = radiance.valid();
    if (!overBackground) radiance = b.create("radiance", ofFirstFrame(c, GL_RGBA32F_ARB));
    const bool surfaces = b.find("pixel marks").valid();
    if (c.hasFirstFrame() || (overBackground && !surfaces)) {
        b.keepContents();
        return;
    }
    b.readGBuffer();
    readTerms(b, c);
    readCatchers(b, c);
    if (c.facts.surfaces.catchers > 0) readBackground(b, c);
    readFog(b, c);
    if (surfaces) drawSurfaces(b);
    overBackground ? b.drawOver(radiance) : b.write(radiance);
}

Requirement DisplayPass::require(const FrameContext& c) const
{
    Requirement display = requirePicture(c);
    display.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    display.unless(c.settings.antialias == Settings::ANTIALIAS_OFF, "the picture is not smoothed");
    display.unless(c.settings.output == Settings::LINEAR, "the host gets linear radiance, pixel by pixel");
    return display.because("the picture is smoothed");
}

void DisplayPass::setup(PassBuilder& b, FrameContext& c)
{
    readShown(b, c);
    if (readExposure(b, c)) b.readGBuffer();
    b.write(b.create("display", {GL_RGBA16, 0, false, false, true}));
}

Requirement CompositePass::require(const FrameContext& c) const
{
    Requirement composite;
    return composite.because("into the host's colour and depth, " + c.behind);
}

void CompositePass::setup(PassBuilder& b, FrameContext& c)
{
    const Settings& s = c.settings;
    b.writeHost();
    b.readGBuffer();
    b.define("BACKGROUND", c.background != Settings::BACKGROUND_OFF);
    const bool averaged = c.shownPicture.valid();
    const TextureId picture = averaged ? c.shownPicture : b.find("display");
    if (picture.valid()) {
        b.settings<OutputSettings>();
        b.define("ANTIALIASED");
        b.read(picture, "displayMap");
        b.define("TEMPORAL", averaged);
        if (averaged) b.read(c.shownPlaces, "placeMap");
        b.define("ACCUMULATED", !averaged && c.hasFirstFrame());
        if (c.background == Settings::BACKGROUND_OFF) b.blendOverHost();
    } else {
        if (c.background == Settings::BACKGROUND_OFF && c.facts.surfaces.catchers > 0) b.blendOverHost();
        readExposure(b, c);
        if (!readShown(b, c)) {
            b.define("VIEW_TERM");
            readTerms(b, c);
        }
    }
    b.define("OUTPUT_LINEAR", s.output == Settings::LINEAR);
    if (s.view != Settings::LIGHT_LIST) return;
    b.bind(c.textures->latlong(), "latlongMap");
    b.bind(c.textures->diffuseLights(), "diffuseLightMap");
    readSuns(b, c);
}

Requirement ForwardPass::require(const FrameContext& c) const
{
    Requirement forward;
    forward.unless(c.facts.surfaces.litForward == 0, "no transparent surface in view");
    return forward.because(counted(c.facts.surfaces.litForward, "transparent drawable") + ", in the host's order");
}

void ForwardPass::setup(PassBuilder& b, FrameContext& c)
{
    osg::StateSet& s = *c.frame.forwardState;
    b.fill(s);
    s.setAttribute(c.shaders.program("pass/surface.vert", "pass/forward.frag"),
                   osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
    s.addUniform(new osg::Uniform("baseColorMap", 0));
    b.frameUniforms(c.frame.uniforms.get());
    b.settings<SurfaceSettings>();
    readExposure(b, c);
    readFog(b, c);
    readIrradiance(b, c);
    if (c.settings.specular && !c.facts.mapIsBlack) {
        b.define("HAS_SPECULAR");
        b.bind(c.textures->pyramid(), "pyramidMap");
    }
    b.define("ENVLIGHT_LIT");
    b.bind(c.albedoTable, "albedoTable");
    defineLobes(b, c.facts.surfaces.forwardLobes);
    b.defineKinds(c.facts.surfaces.forwardLobes);
    b.define("OUTPUT_LINEAR", c.settings.output == Settings::LINEAR);
    if (c.decisions.suns.needed) {
        b.define("HAS_SUNS");
        b.define("SUN_DIFFUSE", c.decisions.sunDiffuse);
        readSuns(b, c);
    }
    const auto addPlace = [&](const char* name, const osg::Vec3d& origin) {
        s.addUniform(new osg::Uniform(name, osg::Matrixf(c.worldFromEye * osg::Matrixd::translate(-origin))));
    };
    if (c.skyMaps) {
        b.define("HAS_ATLAS");
        readSkyMaps(b, c, "atlas", *c.skyMaps, c.nearSkyMaps);
        addPlace("atlasFromEye", c.skyMaps->origin());
    }
    if (c.sunMaps) {
        b.define("HAS_SUN_MAPS");
        readSunMaps(b, c);
        addPlace("sunsFromEye", c.sunMaps->targets().origin);
    }
    if (c.emitterMaps) {
        b.define("HAS_AREA_LIGHTS");
        readEmitterPoints(b, *c.emitterMaps, c.emitterPoints);
        addPlace("emittersFromEye", c.emitterMaps->origin());
    }
    if (!c.lights.empty()) {
        b.define("HAS_SCENE_LIGHTS");
        b.frameUniforms(&c.frame.sceneLightState());
    }
    if (c.sceneLightMaps) {
        b.define("HAS_SCENE_LIGHT_MAPS");
        readSceneLightMaps(b, c);
        addPlace("sceneLightMapsFromEye", c.sceneLightMaps->origin());
    }
    if (b.read("bounce", "bounceMap")) b.define("HAS_BOUNCE");
    if (c.indirect) {
        b.define("HAS_PROBES");
        readProbes(b, *c.indirect);
        b.frameUniforms(&c.frame.probeState(c.indirect->share));
        addPlace("probesFromEye", c.indirect->scene->origin);
    }
}

}  // namespace osgEnvLight
