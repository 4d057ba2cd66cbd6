// SPDX-License-Identifier: MIT
#include "passes/Indirect.h"

#include "base/Limits.h"
#include "gl/BindTargets.h"
#include "indirect/BounceDraw.h"
#include "indirect/ReflectiveMaps.h"
#include "passes/Inputs.h"
#include "passes/Links.h"
#include "passes/NearLight.h"

#include <osg/Depth>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const unsigned mostBounces = 64;  // after a change: in a closed room of albedo .9 they leave out a thousandth of the light
const double leftOut = 1e-3;      // where less is reflected, fewer leave out no more
const unsigned bouncesPerFrame = 4;
const unsigned lightTurns = 8;  // frames in which all points are lit, while light changes steadily

// A bounce is no more than that share of the one before it.
unsigned bouncesAfterChange(double mostReflected)
{
    if (!(mostReflected > 0.0)) return 1;
    if (mostReflected >= 1.0) return mostBounces;
    return unsigned(std::clamp(std::ceil(std::log(leftOut) / std::log(mostReflected)), 1.0, double(mostBounces)));
}

Requirement requireScene(const FrameContext& c)
{
    return requireProbes(c).unless(!c.indirect, "there are no probes yet");
}

}  // namespace

PointsPass::Key PointsPass::keyOf(const FrameContext& c)
{
    Key key;
    key.scene = c.indirect->scene;
    key.textures = c.textures.get();
    key.sky = c.skyMaps;
    key.skyVersion = c.skyMaps->version();
    key.nearSky = c.nearSkyMaps;
    key.nearSkyVersion = c.nearSkyMaps ? c.nearSkyMaps->version() : 0;
    key.suns = c.sunMaps;
    key.sunsVersion = c.sunMaps ? c.sunMaps->version() : 0;
    key.emitters = c.emitterMaps;
    key.emittersVersion = c.emitterMaps ? c.emitterMaps->version() : 0;
    if (c.sceneLightMaps) {
        key.lamps = c.sceneLightMaps;
        key.lampsVersion = c.sceneLightMaps->version();
        for (const SceneLight& light : c.lights) {
            key.falloffs.push_back(light.falloff);
            key.cones.push_back(light.spot[3]);
        }
    }
    key.diffuse = c.indirect->diffuse;
    key.glossy = c.indirect->glossy;
    if (c.caustics) key.virtualLights = c.caustics->targets.virtualLights;
    key.mapFromWorld = c.mapFromWorld;
    key.radianceScale = c.radianceScale;
    return key;
}

Requirement PointsPass::require(const FrameContext& c) const
{
    return requireScene(c).because("light of the map, its suns and lamps at surface points, where it changes");
}

// A change of light reaches the points in turns. While it does, each frame adds one bounce; from the last turn on it adds
// several. No frame waits for the last bounce: another change may follow at once, as with a video for a map.
void PointsPass::update(FrameContext& c)
{
    IndirectLight& light = *c.indirect;
    const Key key = keyOf(c);
    const bool changed = light.fresh || !(key == _key);
    const bool immediate = c.settings.regeneration == Settings::IMMEDIATE;
    const bool neverMirrored = light.glossy && !_key.glossy;
    const bool atOnce = light.fresh || neverMirrored || immediate || key.scene != _key.scene;
    _key = key;
    if (changed) {
        light.turns = atOnce ? 1 : lightTurns;
        light.laterBounces = bouncesAfterChange(light.mostReflected);
    }
    light.rows = light.turns > 0 ? (atOnce ? 1 : lightTurns) : 0;
    if (light.turns > 0) --light.turns;
    if (light.turns > 0) {
        light.bounces = 1;
    } else {
        light.bounces = immediate ? light.laterBounces : std::min(light.laterBounces, bouncesPerFrame);
        light.laterBounces -= light.bounces;
    }
    if (light.isSettling()) ++c.waitingBounces;
}

void PointsPass::setup(PassBuilder& b, FrameContext& c)
{
    const IndirectLight& light = *c.indirect;
    if (light.rows == 0) return;
    b.bind(light.scene->pointPlaces, "pointPlaceMap");
    b.bind(light.scene->pointNormals, "pointNormalMap");
    readSkyMaps(b, c, "atlas", *c.skyMaps, c.nearSkyMaps);
    readReceivedLight(b, c, name(), *c.skyMaps);
    const bool hasSuns = c.sunMaps && c.decisions.sunDiffuse;
    if (hasSuns || c.sceneLightMaps) {
        b.bind(light.scene->partPlaces, "partPlaceMap");
        b.bind(light.scene->partNormals, "partNormalMap");
    }
    osg::Vec3d inSunMaps;
    if (hasSuns) {
        b.define("HAS_SUN_MAPS");
        readSuns(b, c);
        readSunMaps(b, c);
        inSunMaps = light.scene->origin - c.sunMaps->targets().origin;
    }
    b.frameUniforms(&c.frame.pointState(int(light.rows), int(c.number % light.rows), inSunMaps));
    b.write(b.import("point light", light.targets.pointLight.get()));
    if (light.glossy) {
        b.define("HAS_GLOSS");
        b.bind(c.atlasLights.nearest("atlas", *c.skyMaps), "nearestLightMap");
        b.write(b.import("point mirrored", light.targets.pointMirrored.get()));
    }
    if (c.caustics && light.glossy) {
        b.define("HAS_CAUSTICS");
        b.bind(light.glossy, "pointGlossyMap");
        b.bind(c.caustics->targets.virtualLights, "virtualLightMap");
        b.frameUniforms(&c.frame.causticState(*c.caustics));
    }
    b.drawAlways();
}

Requirement BouncesPass::require(const FrameContext& c) const
{
    return requireScene(c).because("light that surface points send on, by what the probes see");
}

void BouncesPass::setup(PassBuilder& b, FrameContext& c)
{
    IndirectLight& light = *c.indirect;
    if (light.bounces == 0) return;
    if (_target != light.targets.irradianceTarget) {
        _target = light.targets.irradianceTarget;
        _camera = new StageCamera;
        BindTargets::install(*_camera, light.targets.irradianceTarget.get(), _failure.get());
    }
    StageDraw& draw = c.frame.draw(name(), [&] { return new BounceDraw(c.frame.triangle.get()); });
    auto& bounces = static_cast<BounceDraw&>(draw.drawable());
    bounces.prepare(light.targets, statesOf(b, c), light.bounces, c.timed(name()));
    b.draw({name(), &bounces, _camera});
    light.fresh = light.relinked = false;
}

BounceDraw::States BouncesPass::statesOf(PassBuilder& b, FrameContext& c) const
{
    const IndirectLight& light = *c.indirect;
    const TransportScene& scene = *light.scene;
    using Samplers = std::vector<StateSets::Sampler>;
    const auto state = [&](const char* shader, std::vector<std::string> defines, const Samplers& samplers) {
        StateSets::Key key{shader, defines, {}};
        for (const StateSets::Sampler& s : samplers) key.objects.push_back(s.texture.get());
        const StateSets::State made = b.states().get(key);
        if (!made.isNew) return osg::ref_ptr<osg::StateSet>(&made.stateSet);
        osg::StateSet& s = made.stateSet;
        for (const std::string& d : defines) s.setDefine(d);
        s.setAttribute(c.shaders.program("pass/fullscreen.vert", shader), fixedOn);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false), osg::StateAttribute::OFF);
        for (unsigned unit = 0; unit < samplers.size(); ++unit) StateSets::bind(s, unit, samplers[unit]);
        return osg::ref_ptr<osg::StateSet>(&s);
    };
    Samplers points = {{"pointPlaceMap", scene.pointPlaces},
                       {"pointNormalMap", scene.pointNormals},
                       {"pointLightMap", light.targets.pointLight},
                       {"pointDiffuseMap", light.diffuse}};
    Samplers cells = {{"pointRadianceMap", light.targets.pointRadiance}, {"pointDiffuseMap", light.diffuse}};
    std::vector<std::string> defines;
    if (light.glossy) {
        cells.push_back({"pointGlossyMap", light.glossy});
        defines.push_back("HAS_GLOSS");
        points.push_back({"pointGlossyMap", light.glossy});
        points.push_back({"pointMirroredMap", light.targets.pointMirrored});
    }
    if (light.emissions) {
        defines.push_back("HAS_EMISSION");
        points.push_back({"pointEmissionMap", light.emissions});
        cells.push_back({"pointEmissionMap", light.emissions});
    }
    BounceDraw::States states;
    states.uniforms = {c.frame.uniforms, &c.frame.settingsState(SurfaceSettings::properties, c.settings), scene.uniforms};
    if (light.fresh) {
        defines.push_back("FIRST_BOUNCE");
        states.first = state("pass/pointradiance.frag", defines, points);
        defines.pop_back();
    }
    if (scene.lattices > 0) defines.push_back("HAS_PROBE_LATTICES");
    points.push_back({"probePlaceMap", scene.probePlaces});
    points.push_back({"probeDepthMap", scene.probeDepths});
    points.push_back({"probeIrradianceMap", light.targets.probeIrradiance});
    if (light.relinked && !light.fresh) states.first = state("pass/pointradiance.frag", defines, points);
    if (scene.pointLinks) {
        defines.push_back("HAS_POINT_LINKS");
        points.push_back({"pointNearMap", light.targets.pointNear});
        states.near = state("pass/pointnear.frag", {},
                            {{"pointLinkMap", scene.pointLinks}, {"pointRadianceMap", light.targets.pointRadiance}});
    }
    states.points = state("pass/pointradiance.frag", defines, points);
    if (scene.rays) {
        cells.push_back({"cellPointMap", scene.rays->cellPoints});
        states.cells = state("pass/surfacecells.frag", defines, cells);
    }
    states.harmonics = state("pass/probeharmonics.frag", {},
                             {{"probeLinkMap", scene.probeLinks},
                              {"probeBasisMap", scene.probeBasis},
                              {"pointRadianceMap", light.targets.pointRadiance}});
    const auto& harmonics = light.targets.probeHarmonics;
    states.probes = state("pass/probes.frag", {},
                          {{"harmonicsMap0", harmonics[0]}, {"harmonicsMap1", harmonics[1]}, {"harmonicsMap2", harmonics[2]}});
    return states;
}

Requirement IndirectPass::require(const FrameContext& c) const
{
    return requireScene(c).because("what surfaces receive from others, by the eight probes about a pixel");
}

void IndirectPass::setup(PassBuilder& b, FrameContext& c)
{
    const IndirectLight& light = *c.indirect;
    const bool lobes = c.facts.surfaces.hasLobes() && c.settings.specular && lobesShowScene(c);
    const bool isMixed = requireNearLight(c).needed;  // with what is near
    const TextureId received = isMixed ? b.create("probe light") : b.create("indirect", ofFirstFrame(c, GL_RGBA16F_ARB));
    const TextureId mirrored = lobes ? b.create("mirrored", ofFirstFrame(c, GL_RGBA16F_ARB)) : TextureId();
    if (c.hasFirstFrame()) {
        b.keepContents();
        return;
    }
    b.readGBuffer();
    readProbes(b, light);
    b.read(b.find("occlusion"), "occlusionTermMap");
    b.define("HAS_OCCLUSION");
    if (light.share < 1.0 && b.read("bounce", "bounceMap")) b.define("HAS_BOUNCE");
    b.frameUniforms(&c.frame.probeState(light.share));
    if (!isMixed && b.read("caustics", "causticMap")) b.define("HAS_CAUSTICS");
    b.shadowOrigin(light.scene->origin);
    drawSurfaces(b);
    b.write(received);
    if (!lobes) return;
    b.define("HAS_LOBES");
    b.write(mirrored);
}

}  // namespace osgEnvLight
