// SPDX-License-Identifier: MIT
#include "passes/AreaLights.h"

#include "base/Limits.h"
#include "gl/TargetTexture.h"
#include "passes/AreaTables.h"
#include "passes/Inputs.h"
#include "passes/Occlusion.h"
#include "shadow/DepthProbe.h"
#include "surface/LtcTable.h"

#include <algorithm>
#include <utility>

namespace osgEnvLight
{

namespace
{

// So many lights have closed forms in each pixel. Of more, a cut through a tree of them decides which have, or points stand for
// all.
const size_t mostClosedForms = 8;

Requirement requireLights(const FrameContext& c)
{
    Requirement lights;
    lights.unless(c.facts.areaLights == 0, "no area light");
    lights.unless(!c.facts.ownGBuffer, "the application's own G-buffer says what surfaces emit");
    return lights.unless(!c.settings.diffuse && !c.settings.specular, "switched off");
}

Requirement requireReceivers(const FrameContext& c, Requirement lights)
{
    return lights.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
}

Requirement requireMaps(const FrameContext& c)
{
    return requireEmitterMaps(c, requireLights(c));
}

bool areMany(const FrameContext& c)
{
    return c.facts.areaLights > mostClosedForms;
}

// Points that may change to another light in a frame, with their maps: after the view has jumped most of them do, and a few
// frames are enough.
unsigned pointsAtOnce(const PointChoice& choice, const FrameContext& c)
{
    return std::max(unsigned(c.settings.atlasUpdatesPerFrame), choice.waiting() / 4);
}

// In a still view's average chosen points stand for all lights. The mean of their sums is right; the mean of the share that is
// seen is not.
bool pointsStandForThem(const FrameContext& c)
{
    if (!c.emitterMaps || !areMany(c)) return false;
    return c.settings.manyLights == Settings::MANY_LIGHTS_POINTS || (c.lightsWithPoints && c.isAccumulating());
}

bool needsCuts(const FrameContext& c)
{
    return areMany(c) && !pointsStandForThem(c);
}

// About which passes have the area lights, in the world.
osg::Vec3d lightOrigin(const FrameContext& c)
{
    return c.emitterMaps ? c.shownEmitterMaps()->origin() : c.areaLights.front().center;
}

const char* howLit(const FrameContext& c)
{
    if (needsCuts(c)) return ", by a cut through a tree of them in each pixel";
    return areMany(c) ? ", for which their points stand" : ", each by its closed form";
}

bool lightsLobes(const FrameContext& c)
{
    return c.settings.specular && c.facts.surfaces.hasLobes();
}

// Points that stand for lights have their pictures' colours themselves.
bool hasPictures(const FrameContext& c)
{
    return !pointsStandForThem(c) && std::any_of(c.areaLights.begin(), c.areaLights.end(), showsPicture);
}

}  // namespace

Requirement AreaMapsPass::require(const FrameContext& c) const
{
    const std::string side = std::to_string(c.settings.areaMapSize);
    return requireMaps(c).because(counted(areaPointsOf(c), "map") + " of " + side + " x " + side + " of " +
                                  counted(c.facts.casters, "drawable") + ", from points on " +
                                  counted(c.facts.areaLights, "area light"));
}

Requirement requireChosenPoints(const FrameContext& c)
{
    Requirement choice = requireMaps(c);
    return choice.unless(countLitSides(c.areaLights) <= areaPointsOf(c), "all area lights have points");
}

void AreaMapsPass::update(FrameContext& c)
{
    const unsigned count = areaPointsOf(c);
    const auto size = unsigned(c.settings.areaMapSize);
    if (requireChosenPoints(c).needed) {
        const bool all = c.settings.regeneration == Settings::IMMEDIATE;
        const std::vector<EmitterPoint>& points =
            _choice.update(c.areaLights, count, c.seen ? &c.seen->points : nullptr, all ? count : pointsAtOnce(_choice, c));
        c.emitterMaps = &_maps.update(c, points, size, _choice.changed() > unsigned(c.settings.atlasUpdatesPerFrame));
        c.waitingMaps += _choice.waiting();
        if (!_lightsWithPoints || _choice.changed() > 0)
            _lightsWithPoints = tableTexture(lightsWithPointsImage(_choice.sidesWithPoints()));
        c.lightsWithPoints = _lightsWithPoints.get();
    } else {
        forgetChoice();
        c.emitterMaps = &_maps.update(c, emitterPoints(c.areaLights, count), size);
    }
    c.emitterPoints = _maps.points();
}

// Whether this frame adds to a still view's average is known now. It then has points of its own: the average's error goes with
// their number.
void AreaMapsPass::setup(PassBuilder& b, FrameContext& c)
{
    _maps.draw(b, c, name(), name());
    if (!c.still) _stillMaps.drop();
    if (!c.isAccumulating()) return;
    const unsigned count = areaPointsOf(c);
    const std::vector<EmitterPoint> points = requireChosenPoints(c).needed
                                                 ? _choice.ofRound(c.areaLights, count, c.still->frames())
                                                 : emitterPoints(c.areaLights, count, c.still->frames());
    c.stillEmitterMaps = &_stillMaps.update(c, points, unsigned(c.settings.areaMapSize), true);
    c.stillEmitterPoints = _stillMaps.points();
    _stillMaps.draw(b, c, name(), "still areamaps");
}

void AreaMapsPass::dismiss(FrameContext& c)
{
    _stillMaps.drop();
    if (c.showsNothing && c.facts.areaLights > 0 && Decisions::wantsEmitterMaps(c.settings)) return;
    _maps.drop();
    forgetChoice();
}

void AreaMapsPass::forgetChoice()
{
    _choice = {};
    _lightsWithPoints = nullptr;
}

void AreaMapsPass::resizeGLObjectBuffers(unsigned maximum)
{
    MapsPass::resizeGLObjectBuffers(maximum);
    _stillMaps.resizeGLObjectBuffers(maximum);
}

void AreaMapsPass::releaseGLObjects(osg::State* state) const
{
    MapsPass::releaseGLObjects(state);
    _stillMaps.releaseGLObjects(state);
}

Requirement AreaShadowPass::require(const FrameContext& c) const
{
    return requireReceivers(c, requireMaps(c))
        .because(std::to_string(areaPointsOf(c) / limits::LIGHT_GROUPS) + " points a pixel, each asking its map");
}

void AreaShadowPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readEmitterPoints(b, *c.shownEmitterMaps(), c.shownEmitterPoints());
    b.shadowOrigin(c.shownEmitterMaps()->origin());
    if (lightsLobes(c)) {
        b.define("HAS_LOBES");
        readLobes(b, c);
    }
    b.define("HAS_AREA_PICTURES", hasPictures(c));
    drawSurfaces(b);
    writeSums(b, "area sums", "area places");
}

Requirement AreaRowsPass::require(const FrameContext& c) const
{
    return requireReceivers(c, requireMaps(c)).because("averages the 16 groups of points along rows");
}

void AreaRowsPass::setup(PassBuilder& b, FrameContext&)
{
    b.uniform(_cells.get());
    filterRows(b, "area sums", "area places", "area row sums", "area row places");
}

Requirement AreaFilterPass::require(const FrameContext& c) const
{
    return requireReceivers(c, requireMaps(c)).because("averages the 16 groups of points, the rows along columns");
}

void AreaFilterPass::setup(PassBuilder& b, FrameContext&)
{
    b.uniform(_cells.get());
    filterColumns(b, "area row sums", "area row places", b.create("area visibility"));
}

Requirement LightTotalsPass::require(const FrameContext& c) const
{
    Requirement cuts = requireReceivers(c, requireLights(c));
    cuts.unless(!areMany(c), "few area lights");
    cuts.unless(!needsCuts(c), "points stand for the area lights");
    return cuts.because("what one of 2 x 2 pixels gets of " + counted(c.facts.areaLights, "area light"));
}

void LightTotalsPass::setup(PassBuilder& b, FrameContext& c)
{
    const osg::Vec3d origin = lightOrigin(c);
    if (!_tree || _list != c.areaLights || origin != _origin) {
        _tree = tableTexture(lightTreeImage(c.areaLights, origin));
        _list = c.areaLights;
        _origin = origin;
    }
    c.lightTree = _tree.get();
    b.readGBuffer();
    b.shadowOrigin(origin);
    b.bind(_tree.get(), "lightTreeMap");
    b.settings<AreaLightSettings>();
    TextureDesc quads;
    quads.format = GL_R32F;
    quads.half = true;
    b.write(b.create("light totals", quads));
}

void LightTotalsPass::dismiss(FrameContext&)
{
    _tree = nullptr;
    _list.clear();
}

Requirement AreaLightsPass::require(const FrameContext& c) const
{
    return requireReceivers(c, requireLights(c)).because(counted(c.facts.areaLights, "area light") + howLit(c));
}

osg::Texture2D* AreaLightsPass::lightTexture(const std::vector<Emitter>& lights, const osg::Vec3d& origin)
{
    if (_lights && lights == _list && origin == _origin) return _lights.get();
    _lights = tableTexture(areaLightImage(lights, origin));
    _pictures = nullptr;
    _list = lights;
    _origin = origin;
    return _lights.get();
}

void AreaLightsPass::setup(PassBuilder& b, FrameContext& c)
{
    const osg::Vec3d origin = lightOrigin(c);
    b.readGBuffer();
    readLobes(b, c);
    b.bind(lightTexture(c.areaLights, origin), "areaLightMap");
    b.shadowOrigin(origin);
    if (lightsLobes(c)) {
        if (!_ltcTable) _ltcTable = makeLtcTable();
        b.define("HAS_LOBES");
        b.bind(_ltcTable.get(), "ltcTable");
    }
    if (b.read("area visibility", "areaVisibilityMap")) b.define("HAS_AREA_SHADOWS");
    b.define("HAS_DIFFUSE", c.settings.diffuse);
    if (pointsStandForThem(c)) {
        b.define("HAS_AREA_POINTS");
        b.bind(c.shownEmitterPoints(), "emitterPointMap");
    } else if (needsCuts(c)) {
        b.define("HAS_LIGHT_CUTS");
        b.bind(c.lightTree, "lightTreeMap");
        b.read(b.find("light totals"), "lightTotalMap");
        if (c.lightsWithPoints && b.find("area visibility").valid()) {
            b.define("HAS_CHOSEN_POINTS");
            b.bind(c.lightsWithPoints, "lightsWithPointsMap");
        }
        b.settings<AreaLightSettings>();
    }
    // Where surfaces have no lobes, the points' shadows have the colours.
    if (hasPictures(c) && (lightsLobes(c) || !b.find("area visibility").valid())) {
        if (!_pictures) _pictures = areaPictureTexture(c.areaLights);
        b.define("HAS_AREA_PICTURES");
        b.bind(_pictures.get(), "areaPictureMap");
    }
    const auto isPolygon = [](const Emitter& light) { return light.shape == AreaLight::POLYGON; };
    b.define("HAS_POLYGONS", std::any_of(c.areaLights.begin(), c.areaLights.end(), isPolygon));
    drawSurfaces(b);
    b.addTo(b.find("emission"));
}

void AreaLightsPass::dismiss(FrameContext&)
{
    _lights = nullptr;
    _pictures = nullptr;
    _ltcTable = nullptr;
    _list.clear();
}

}  // namespace osgEnvLight
