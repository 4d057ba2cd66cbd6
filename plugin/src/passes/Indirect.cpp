// SPDX-License-Identifier: MIT
#include "passes/Indirect.h"

#include "base/Limits.h"
#include "gl/BindTargets.h"
#include "indirect/BounceDraw.h"
#include "passes/Inputs.h"

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
const unsigned lightTurns = 8;        // frames in which all points are lit, while light changes steadily
const double shareStep = 1.0 / 16.0;  // by which the probes' answer takes the place of the mean in a frame

double mostReflectedBy(const StaticCasters::Parts& parts)
{
    float most = 0.0f;
    for (const StaticCasters::Part& part : parts)
        for (int k = 0; k < 3; ++k) most = std::max(most, part.sent.diffuse[k] + part.sent.glossy[k]);
    return most;
}

// A bounce is no more than that share of the one before it.
unsigned bouncesAfterChange(double mostReflected)
{
    if (!(mostReflected > 0.0)) return 1;
    if (mostReflected >= 1.0) return mostBounces;
    return unsigned(std::clamp(std::ceil(std::log(leftOut) / std::log(mostReflected)), 1.0, double(mostBounces)));
}

Requirement requireProbes(const FrameContext& c)
{
    Requirement probes;
    probes.unless(c.settings.bounce == Settings::BOUNCE_OFF, "switched off");
    probes.unless(c.settings.bounce == Settings::BOUNCE_MEAN, "bounce is mean");
    probes.unless(!c.decisions.occlusion.needed, "no light is blocked");
    probes.unless(!c.decisions.atlas.needed, "without the atlas nobody knows how much of the map a surface sees");
    return probes.unless(c.nearSkyMaps != nullptr, "the view shows too little of the scene for probes all over it");
}

Requirement requireScene(const FrameContext& c)
{
    return requireProbes(c).unless(!c.indirect, "there are no probes yet");
}

}  // namespace

Requirement LinksPass::require(const FrameContext& c) const
{
    return requireProbes(c).because("surface points and probes, made on a thread of their own");
}

void LinksPass::update(FrameContext& c)
{
    if (_lost.exchange(false)) _light.fresh = true;
    const StaticCasters& casters = c.skyMaps->still();
    if (const osg::ref_ptr<TransportScene> made = _worker.take()) accept(made);
    const Wanted wanted{c.skyMaps, casters.generation(), c.settings.bounceProbes};
    if (!(wanted == _wanted)) makeScene(c, wanted);
    if (_isShown && _sentVersion != casters.sentVersion()) {
        _sentVersion = casters.sentVersion();
        showSurfaces(casters.parts());
    }
    keepMirrored();
    if (!_light.scene) ++_frames;
    // The first pictures show the end at once: there is nothing yet that they would jump from.
    const bool first = _frames <= 1 || c.settings.regeneration == Settings::IMMEDIATE;
    if (_light.scene) _light.share = first ? 1.0 : std::min(_light.share + shareStep, 1.0);
    c.indirect = _light.scene && !_light.scene->empty() ? &_light : nullptr;
    if (_worker.busy() || (c.indirect && _light.isSettling())) ++c.waitingBounces;
}

void LinksPass::makeScene(const FrameContext& c, const Wanted& wanted)
{
    _wanted = wanted;
    _wantedParts = c.skyMaps->still().parts();
    _isShown = false;
    const auto make = [parts = _wantedParts, origin = c.skyMaps->origin(),
                       probes = wanted.probes](const std::atomic<bool>* stop) {
        return osg::ref_ptr<TransportScene>(new TransportScene(tracedScene(parts), origin, probes, stop));
    };
    if (c.settings.regeneration == Settings::IMMEDIATE)
        accept(make(nullptr));
    else
        _worker.post([make](const std::atomic<bool>& stop) { return make(&stop); });
}

void LinksPass::accept(const osg::ref_ptr<TransportScene>& scene)
{
    _light.scene = scene;
    _isShown = true;
    _sentVersion = 0;
    if (scene->empty()) return;
    showSurfaces(_wantedParts);
    const int probes = scene->count[0] * scene->count[1] * scene->count[2];
    if (probes == _light.targets.probes) return;  // what the probes saw in the former scene is a beginning in this one
    retireTargets();
    _light.targets = TransportTargets(scene->columns, probes);
    _light.fresh = true;
}

void LinksPass::showSurfaces(const StaticCasters::Parts& parts)
{
    _light.diffuse = _light.scene->diffuse(parts);
    _light.glossy = _light.scene->glossy(parts);
    _light.emissions = _light.scene->emissions(parts);
    _light.mostReflected = mostReflectedBy(parts);
}

// The target of what mirrors send, while something is glossy.
void LinksPass::keepMirrored()
{
    osg::ref_ptr<osg::Texture2D>& mirrored = _light.targets.pointMirrored;
    if (_light.targets.probes == 0 || bool(_light.glossy) == bool(mirrored)) return;
    if (_light.glossy) {
        _light.targets.makePointMirrored();
        return;
    }
    _retired->add(mirrored.get());
    mirrored = nullptr;
}

void LinksPass::retireTargets()
{
    if (_light.targets.probes == 0) return;
    for (osg::Texture2D* t : _light.targets.textures()) _retired->add(t);
    for (osg::FrameBufferObject* f : _light.targets.frameBuffers()) _retired->add(f);
}

void LinksPass::setup(PassBuilder&, FrameContext& c)
{
    if (!c.indirect) return;
    const TransportScene& scene = *c.indirect->scene;
    c.remark(", " + std::to_string(limits::POINT_SIDE * limits::POINT_SIDE) + " points, " + std::to_string(scene.count[0]) +
             " x " + std::to_string(scene.count[1]) + " x " + std::to_string(scene.count[2]) + " probes");
}

void LinksPass::dismiss(FrameContext& c)
{
    if (c.showsNothing && Decisions::wantsAtlas(c.settings)) return;
    _worker.discard();
    retireTargets();
    _light = {};
    _wanted = {};
    _wantedParts.clear();
    _isShown = false;
    _frames = 0;
}

size_t LinksPass::bytes() const
{
    if (!_light.scene) return 0;
    size_t sum = _light.scene->bytes() + _light.targets.bytes();
    for (const auto& t : {_light.diffuse, _light.glossy, _light.emissions})
        if (t) sum += bytesOf(*t);
    return sum;
}

void LinksPass::resizeGLObjectBuffers(unsigned maximum)
{
    _light.targets.resizeGLObjectBuffers(maximum);
    if (_light.scene) _light.scene->resizeGLObjectBuffers(maximum);
    for (const auto& t : {_light.diffuse, _light.glossy, _light.emissions})
        if (t) t->resizeGLObjectBuffers(maximum);
}

void LinksPass::releaseGLObjects(osg::State* state) const
{
    _light.targets.releaseGLObjects(state);
    if (_light.scene) _light.scene->releaseGLObjects(state);
    for (const auto& t : {_light.diffuse, _light.glossy, _light.emissions})
        if (t) t->releaseGLObjects(state);
    _lost = true;
}

PointsPass::Key PointsPass::keyOf(const FrameContext& c)
{
    Key key;
    key.scene = c.indirect->scene;
    key.textures = c.textures.get();
    key.sky = c.skyMaps;
    key.skyVersion = c.skyMaps->version();
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
    key.mapFromWorld = c.mapFromWorld;
    key.radianceScale = c.radianceScale;
    return key;
}

Requirement PointsPass::require(const FrameContext& c) const
{
    return requireScene(c).because("light of the map, its suns and lamps at surface points, where it changes");
}

// A change reaches the points in turns, and goes on between them some bounces a frame: it may be one of many, as of a map that is
// a video, and no frame waits for the last of them.
void PointsPass::update(FrameContext& c)
{
    IndirectLight& light = *c.indirect;
    const Key key = keyOf(c);
    const bool changed = light.fresh || !(key == _key);
    const bool immediate = c.settings.regeneration == Settings::IMMEDIATE;
    const bool neverMirrored = light.glossy && !_key.glossy;
    const bool atOnce = light.fresh || neverMirrored || immediate;
    _key = key;
    if (changed) {
        light.turns = atOnce ? 1 : lightTurns;
        light.laterBounces = bouncesAfterChange(light.mostReflected);
    }
    light.rows = light.turns > 0 ? (atOnce ? 1 : lightTurns) : 0;
    if (light.turns > 0) --light.turns;
    light.bounces = immediate ? light.laterBounces : std::min(light.laterBounces, bouncesPerFrame);
    light.laterBounces -= light.bounces;
    if (light.isSettling()) ++c.waitingBounces;
}

void PointsPass::setup(PassBuilder& b, FrameContext& c)
{
    const IndirectLight& light = *c.indirect;
    if (light.rows == 0) return;
    b.bind(light.scene->pointPlaces, "pointPlaceMap");
    b.bind(light.scene->pointNormals, "pointNormalMap");
    readSkyMaps(b, c, "atlas", *c.skyMaps, nullptr);
    b.define("MAP_IS_BLACK", c.facts.mapIsBlack);
    FrameResources::PointPlaces places;
    places.inAtlas = light.scene->origin - c.skyMaps->origin();
    const bool hasSuns = c.sunMaps && c.decisions.sunDiffuse;
    if (hasSuns || c.sceneLightMaps) {
        b.bind(light.scene->partPlaces, "partPlaceMap");
        b.bind(light.scene->partNormals, "partNormalMap");
    }
    if (hasSuns) {
        b.define("HAS_SUN_MAPS");
        readSuns(b, c);
        readSunMaps(b, c);
        places.inSunMaps = light.scene->origin - c.sunMaps->targets().origin;
    }
    if (c.emitterMaps) {
        b.define("HAS_AREA_LIGHTS");
        readEmitterPoints(b, *c.emitterMaps, c.emitterPoints);
        places.inEmitterMaps = light.scene->origin - c.emitterMaps->origin();
    }
    if (c.sceneLightMaps) {
        b.define("HAS_SCENE_LIGHT_MAPS");
        b.settings<SurfaceSettings>();
        readSceneLightMaps(b, c);
        b.frameUniforms(&c.frame.sceneLightState());
        places.inSceneLightMaps = light.scene->origin - c.sceneLightMaps->origin();
        places.inEye = osg::Matrixd::translate(light.scene->origin) * osg::Matrixd::inverse(c.worldFromEye);
    }
    b.frameUniforms(&c.frame.pointState(places, int(light.rows), int(c.number % light.rows), 0.5 * c.skyMaps->texel()));
    b.write(b.import("point light", light.targets.pointLight.get()));
    if (light.glossy) {
        b.define("HAS_GLOSS");
        b.bind(c.atlasLights.nearest("atlas", *c.skyMaps), "nearestLightMap");
        b.write(b.import("point mirrored", light.targets.pointMirrored.get()));
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
    bounces.prepare(light.targets, statesOf(b, c), light.fresh, light.bounces, c.timed(name()));
    b.draw({name(), &bounces, _camera});
    light.fresh = false;
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
    std::vector<std::string> defines;
    if (light.glossy) {
        defines.push_back("HAS_GLOSS");
        points.push_back({"pointGlossyMap", light.glossy});
        points.push_back({"pointMirroredMap", light.targets.pointMirrored});
    }
    if (light.emissions) {
        defines.push_back("HAS_EMISSION");
        points.push_back({"pointEmissionMap", light.emissions});
    }
    BounceDraw::States states;
    states.uniforms = {c.frame.uniforms, &c.frame.settingsState(SurfaceSettings::properties, c.settings), scene.uniforms};
    if (light.fresh) {
        defines.push_back("FIRST_BOUNCE");
        states.first = state("pass/pointradiance.frag", defines, points);
        defines.pop_back();
    }
    points.push_back({"probePlaceMap", scene.probePlaces});
    points.push_back({"probeDepthMap", scene.probeDepths});
    points.push_back({"probeIrradianceMap", light.targets.probeIrradiance});
    states.points = state("pass/pointradiance.frag", defines, points);
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
    const TextureId received = b.create("indirect", ofFirstFrame(c, GL_RGBA16F_ARB));
    const TextureId mirrored = lobes ? b.create("mirrored", ofFirstFrame(c, GL_RGBA16F_ARB)) : TextureId();
    if (c.hasFirstFrame()) {
        b.keepContents();
        return;
    }
    b.readGBuffer();
    b.bind(light.scene->probePlaces, "probePlaceMap");
    b.bind(light.scene->probeDepths, "probeDepthMap");
    b.bind(light.targets.probeIrradiance, "probeIrradianceMap");
    b.frameUniforms(light.scene->uniforms);
    b.read(b.find("occlusion"), "occlusionTermMap");
    b.define("HAS_OCCLUSION");
    if (light.share < 1.0 && b.read("bounce", "bounceMap")) b.define("HAS_BOUNCE");
    b.frameUniforms(&c.frame.probeState(light.share));
    b.shadowOrigin(light.scene->origin);
    drawSurfaces(b);
    b.write(received);
    if (!lobes) return;
    b.define("HAS_LOBES");
    b.write(mirrored);
}

}  // namespace osgEnvLight
