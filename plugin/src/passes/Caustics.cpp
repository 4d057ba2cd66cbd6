// SPDX-License-Identifier: MIT
#include "passes/Caustics.h"

#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"
#include "gl/BindTargets.h"
#include "indirect/ReflectiveDraw.h"
#include "passes/Inputs.h"
#include "passes/Links.h"
#include "passes/Occlusion.h"
#include "surface/LtcTable.h"

#include <osg/Depth>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

// Of all surfaces that of polished metal must be: of less, as the chessmen, the chains of the swing and a row of balls, nothing
// is seen.
const double leastShare = 1.0 / 32.0;

unsigned roundedUpToPower(unsigned n)
{
    unsigned power = 1;
    while (power < n) power *= 2;
    return power;
}

osg::BoundingBoxd boundOfMirrors(const std::vector<Caster>& casters)
{
    osg::BoundingBoxd box;
    for (const Caster& caster : casters)
        if (!caster.moves && isPolished(caster.sent)) box.expandBy(boundOf(caster));
    return box;
}

ReflectedLight reflectedSun(const DominantLight& sun, double mean)
{
    ReflectedLight light;
    light.position = osg::Vec4d(sun.direction, 0.0);
    light.irradiance = osg::Vec3f(sun.flux * ((1.0 + std::cos(sun.radius)) / (2.0 * osg::PI * mean)));
    light.radius = sun.radius;
    return light;
}

ReflectedLight reflectedLamp(const SceneLight& lamp, int number, const osg::Matrixd& worldFromEye)
{
    ReflectedLight light;
    light.position = osg::Vec4d(lamp.position) * worldFromEye;
    if (lamp.position.w() == 0.0f) light.position.w() = 0.0;
    light.sceneLight = number;
    return light;
}

// Those that have shadow maps, suns first.
std::vector<ReflectedLight> reflectedLights(FrameContext& c, Caustics& caustics)
{
    std::vector<ReflectedLight> lights;
    caustics.suns = caustics.sceneLights = 0;
    const auto isFull = [&] { return lights.size() == size_t(limits::MOST_REFLECTED_LIGHTS); };
    if (c.sunMaps && c.decisions.sunDiffuse) {
        int i = 0;
        for (const DominantLight& sun : c.inWorld(c.textures->suns())) {
            if (isFull()) break;
            lights.push_back(reflectedSun(sun, c.textures->map().mean));
            caustics.suns |= 1 << i++;
        }
    }
    for (size_t i = 0; c.sceneLightMaps && i < c.lights.size() && !isFull(); ++i) {
        if (c.lights[i].ofView) continue;
        lights.push_back(reflectedLamp(c.lights[i], int(i), c.worldFromEye));
        caustics.sceneLights |= 1 << int(i);
    }
    return lights;
}

Requirement requireSwitchedOn(const FrameContext& c)
{
    return requireProbes(c).unless(c.settings.caustics == Settings::CAUSTICS_OFF, "switched off");
}

Requirement requireCaustics(const FrameContext& c)
{
    return requireSwitchedOn(c).unless(!c.caustics, "no polished metal is lit by a sun or lamp");
}

}  // namespace

Requirement ReflectiveMapsPass::require(const FrameContext& c) const
{
    Requirement maps = requireSwitchedOn(c).unless(!c.indirect, "there are no probes yet");
    const bool hasLights = (c.sunMaps && c.decisions.sunDiffuse) || c.sceneLightMaps;
    maps.unless(!hasLights, "no sun or lamp has a shadow map");
    if (!maps.needed) return maps;
    const bool matters = c.settings.caustics == Settings::CAUSTICS_ON || c.indirect->polishedShare >= leastShare;
    maps.unless(!matters, "too little is of polished metal");
    return maps.unless(maps.needed && !boundOfMirrors(c.casters.all).valid(), "nothing is of polished metal")
        .because("what polished metal reflects of suns and lamps, where it changes");
}

void ReflectiveMapsPass::drop()
{
    const ReflectiveTargets& targets = _caustics.targets;
    if (targets.target) {
        for (osg::Texture2D* t : targets.textures()) _retired->add(t);
        _retired->add(targets.target.get());
    }
    _caustics.targets = {};
    _camera = nullptr;
}

void ReflectiveMapsPass::makeTargets(unsigned size, unsigned lights)
{
    const unsigned columns = _caustics.maps.size() > 1 ? 2 : 1;
    const ReflectiveTargets& there = _caustics.targets;
    if (there.size == size && there.columns == columns && there.lights == lights) return;
    drop();
    _caustics.targets = ReflectiveTargets(size, columns, lights);
    _camera = new StageCamera;
    BindTargets::install(*_camera, _caustics.targets.target.get(), _failure.get());
}

void ReflectiveMapsPass::update(FrameContext& c)
{
    const osg::BoundingBoxd mirrors = boundOfMirrors(c.casters.all);
    _caustics.origin = c.indirect->scene->origin;
    _caustics.lift = c.skyMaps->texel();
    _caustics.pointWidth = 0.5 * c.indirect->scene->pointSpacing;
    _caustics.maps.clear();
    const unsigned size = roundedUpToPower(unsigned(c.settings.causticMapSize));
    for (const ReflectedLight& light : reflectedLights(c, _caustics))
        _caustics.maps.push_back(reflectiveMap(light, mirrors, _caustics.origin, size));
    if (_caustics.maps.empty()) return;
    makeTargets(size, wholeGroups(c.settings.causticLights));
    c.caustics = &_caustics;
}

void ReflectiveMapsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.caustics) return;
    c.remark(", " + counted(_caustics.maps.size(), "map"));
    if (c.indirect->rows == 0) return;  // new targets and lost ones change the points' light, too
    const StateSets::State state = b.states().get({"reflective map", {c.sceneLightMaps ? "HAS_SCENE_LIGHTS" : ""}, {}});
    if (state.isNew) {
        osg::StateSet& s = state.stateSet;
        s.setAttribute(c.shaders.program("pass/caster.vert", "pass/reflectivemap.frag"), fixedOn);
        s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, true), fixedOn);
        s.setMode(GL_DEPTH_CLAMP, fixedOn);  // what lies nearer to the light hides what reflects
        s.addUniform(new osg::Uniform("baseColorMap", 0));
        s.setDefine("CASTER_REFLECTS");
        if (c.sceneLightMaps) s.setDefine("HAS_SCENE_LIGHTS");
    }
    std::vector<osg::ref_ptr<osg::StateSet>> uniforms = {
        c.frame.uniforms, &c.frame.settingsState(SurfaceSettings::properties, c.settings), &c.frame.causticState(_caustics),
        &c.frame.placeState(name(), pixelPlaces(c))};
    if (c.sceneLightMaps) uniforms.push_back(&c.frame.sceneLightState());
    StageDraw& draw = c.frame.draw(name(), [] { return new ReflectiveDraw; });
    auto& maps = static_cast<ReflectiveDraw&>(draw.drawable());
    maps.prepare(_caustics.targets, _caustics.maps, c.casters.all, uniforms, &state.stateSet, _caustics.origin, c.timed(name()));
    b.draw({name(), &maps, _camera});
}

void ReflectiveMapsPass::dismiss(FrameContext&)
{
    drop();
}

Requirement VirtualLightsPass::require(const FrameContext& c) const
{
    return requireCaustics(c).because("places on polished metal, by the power that they reflect");
}

void VirtualLightsPass::setup(PassBuilder& b, FrameContext& c)
{
    const Caustics& caustics = *c.caustics;
    c.remark(", " + counted(caustics.targets.lights, "virtual light"));
    if (c.indirect->rows == 0) return;
    if (!_ltcTable) _ltcTable = makeLtcTable();
    b.bind(caustics.targets.flux, "reflectedFluxMap");
    b.bind(caustics.targets.places, "reflectorPlaceMap");
    b.bind(caustics.targets.normals, "reflectorNormalMap");
    b.bind(_ltcTable, "ltcTable");
    if (c.indirect->scene->rays) {
        b.define("HAS_SCENE_RAYS");
        b.bind(c.indirect->scene->rays->nodes, "rayNodeMap");
        b.bind(c.indirect->scene->rays->triangles, "rayTriangleMap");
    }
    b.frameUniforms(&c.frame.causticState(caustics));
    b.write(b.import("virtual lights", caustics.targets.virtualLights.get()));
    b.drawAlways();
}

Requirement CausticsPass::require(const FrameContext& c) const
{
    return requireCaustics(c).because("a sixteenth of the virtual lights in each pixel");
}

void CausticsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    b.readGBuffer();
    b.bind(c.caustics->targets.virtualLights, "virtualLightMap");
    b.shadowOrigin(c.caustics->origin);
    drawSurfaces(b);
    writeSums(b, "caustic sums", "caustic places");
}

Requirement CausticRowsPass::require(const FrameContext& c) const
{
    return requireCaustics(c).because("averages the 16 groups of virtual lights along rows");
}

void CausticRowsPass::setup(PassBuilder& b, FrameContext& c)
{
    if (c.hasFirstFrame()) return;
    b.define("COMBINE_SUM");
    b.uniform(_cells.get());
    filterRows(b, "caustic sums", "caustic places", "caustic row sums", "caustic row places");
}

Requirement CausticFilterPass::require(const FrameContext& c) const
{
    return requireCaustics(c).because("averages the 16 groups of virtual lights, the rows along columns");
}

void CausticFilterPass::setup(PassBuilder& b, FrameContext& c)
{
    const TextureId caustics = b.create("caustics", ofFirstFrame(c, GL_RGBA16F_ARB));
    if (c.hasFirstFrame()) {
        b.keepContents();
        return;
    }
    b.define("COMBINE_SUM");
    b.uniform(_cells.get());
    filterColumns(b, "caustic row sums", "caustic row places", caustics, 0.0f);
}

}  // namespace osgEnvLight
