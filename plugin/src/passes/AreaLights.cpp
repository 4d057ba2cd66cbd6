// SPDX-License-Identifier: MIT
#include "passes/AreaLights.h"

#include "base/Limits.h"
#include "gl/TargetTexture.h"
#include "passes/Inputs.h"
#include "passes/Occlusion.h"
#include "surface/LtcTable.h"

#include <algorithm>
#include <utility>

namespace osgEnvLight
{

namespace
{

// So many lights have closed forms. Of more, all points stand for them, and a pixel's time does not grow with their number any
// more.
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

bool pointsStandForThem(const FrameContext& c)
{
    return c.emitterMaps && c.facts.areaLights > mostClosedForms;
}

bool lightsLobes(const FrameContext& c)
{
    return c.settings.specular && c.facts.surfaces.hasLobes();
}

// u and v; of a polygon two vectors whose cross product is its area along its normal.
std::pair<osg::Vec3d, osg::Vec3d> axesOf(const Emitter& light)
{
    if (light.shape != AreaLight::POLYGON) return {light.u, light.v};
    const auto shorter = [](const osg::Vec3d& a, const osg::Vec3d& b) { return a.length2() < b.length2(); };
    const osg::Vec3d& u = *std::max_element(light.vertices.begin(), light.vertices.end(), shorter);
    return {u, (light.normal ^ u) * (light.area / u.length2())};
}

// As pass/arealights.glsl reads them.
osg::ref_ptr<osg::Image> lightImage(const std::vector<Emitter>& lights, const osg::Vec3d& origin)
{
    size_t vertices = 0;
    for (const Emitter& light : lights) vertices = std::max(vertices, light.vertices.size());
    int pictures = 0;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(lights.size()), limits::AREA_LIGHT_ROWS + int(vertices), 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    for (size_t i = 0; i < lights.size(); ++i) {
        const Emitter& light = lights[i];
        const auto [u, v] = axesOf(light);
        writeTexel(*image, unsigned(i), 0, light.center - origin, light.extent() * light.extent());
        writeTexel(*image, unsigned(i), 1, light.radiance,
                   light.shape + (light.twoSided ? 4 : 0) + 8 * int(light.vertices.size()));
        writeTexel(*image, unsigned(i), 2, u, light.picture ? pictures++ : -1);
        writeTexel(*image, unsigned(i), 3, v, light.pictureTurned ? -1.0 : 1.0);
        for (size_t k = 0; k < vertices; ++k)
            writeTexel(*image, unsigned(i), unsigned(limits::AREA_LIGHT_ROWS + k),
                       k < light.vertices.size() ? light.vertices[k] : osg::Vec3d(), 0.0);
    }
    return image;
}

bool showsPicture(const Emitter& light)
{
    return light.picture.valid();
}

// Points that stand for lights have their pictures' colours themselves.
bool hasPictures(const FrameContext& c)
{
    return !pointsStandForThem(c) && std::any_of(c.areaLights.begin(), c.areaLights.end(), showsPicture);
}

// A layer each, in the order of the lights.
osg::ref_ptr<osg::Texture2DArray> pictureTexture(const std::vector<Emitter>& lights)
{
    const auto count = int(std::count_if(lights.begin(), lights.end(), showsPicture));
    osg::ref_ptr<osg::Texture2DArray> texture = new osg::Texture2DArray;
    texture->setTextureSize(int(EmitterPicture::side), int(EmitterPicture::side), count);
    texture->setInternalFormat(GL_RGB16F_ARB);
    texture->setSourceFormat(GL_RGB);
    texture->setSourceType(GL_FLOAT);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    unsigned layer = 0;
    for (const Emitter& light : lights)
        if (light.picture) texture->setImage(layer++, new osg::Image(light.picture->relative()));
    return texture;
}

}  // namespace

Requirement AreaMapsPass::require(const FrameContext& c) const
{
    const std::string side = std::to_string(c.settings.areaMapSize);
    return requireMaps(c).because(counted(areaPointsOf(c.settings), "map") + " of " + side + " x " + side + " of " +
                                  counted(c.facts.casters, "drawable") + ", from points on " +
                                  counted(c.facts.areaLights, "area light"));
}

void AreaMapsPass::update(FrameContext& c)
{
    c.emitterMaps = &_maps.update(c, emitterPoints(c.areaLights, areaPointsOf(c.settings)), unsigned(c.settings.areaMapSize));
    c.emitterPoints = _maps.points();
}

// Whether this frame adds to a still view's average is known now. It then has points of its own: the average's error goes with
// their number.
void AreaMapsPass::setup(PassBuilder& b, FrameContext& c)
{
    _maps.draw(b, c, name(), name());
    if (!c.still) _stillMaps.drop();
    if (!c.isAccumulating()) return;
    const std::vector<EmitterPoint> points = emitterPoints(c.areaLights, areaPointsOf(c.settings), c.still->frames());
    c.stillEmitterMaps = &_stillMaps.update(c, points, unsigned(c.settings.areaMapSize), true);
    c.stillEmitterPoints = _stillMaps.points();
    _stillMaps.draw(b, c, name(), "still areamaps");
}

void AreaMapsPass::dismiss(FrameContext& c)
{
    _stillMaps.drop();
    if (!(c.showsNothing && c.facts.areaLights > 0 && Decisions::wantsEmitterMaps(c.settings))) _maps.drop();
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
        .because(std::to_string(areaPointsOf(c.settings) / limits::LIGHT_GROUPS) + " points a pixel, each asking its map");
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

Requirement AreaLightsPass::require(const FrameContext& c) const
{
    return requireReceivers(c, requireLights(c))
        .because(counted(c.facts.areaLights, "area light") +
                 (pointsStandForThem(c) ? ", for which their points stand" : ", each by its closed form"));
}

osg::Texture2D* AreaLightsPass::lightTexture(const std::vector<Emitter>& lights, const osg::Vec3d& origin)
{
    if (_lights && lights == _list && origin == _origin) return _lights.get();
    _lights = tableTexture(lightImage(lights, origin));
    _pictures = nullptr;
    _list = lights;
    _origin = origin;
    return _lights.get();
}

void AreaLightsPass::setup(PassBuilder& b, FrameContext& c)
{
    const osg::Vec3d origin = c.emitterMaps ? c.shownEmitterMaps()->origin() : c.areaLights.front().center;
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
    }
    // Where surfaces have no lobes, the points' shadows have the colours.
    if (hasPictures(c) && (lightsLobes(c) || !b.find("area visibility").valid())) {
        if (!_pictures) _pictures = pictureTexture(c.areaLights);
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
