// SPDX-License-Identifier: MIT
#include "lights/MapTextures.h"

#include "environment/Exposure.h"
#include "environment/PrefilteredMap.h"
#include "environment/SphericalHarmonics.h"
#include "lights/IrradianceMap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double largestHalf = 65504.0;

}  // namespace

MapTextures::MapTextures(const RadianceMap* map, const MapOptions& options)
    : _map(map), _options(options), _scale(map->mean > 0.0 ? 1.0 / map->mean : 0.0), _side(osgEnvLight::pyramidSide(map->width))
{
}

MapTextures::MapTextures(const RadianceMap* map, const Continuation& former) : MapTextures(map, former.options)
{
    if (former.grid && former.grid->side() == _side) _grid = former.grid;
    _formerSuns = former.suns;
    _carrier = former.carrier;
    _diffuse = former.diffuse;
    _occlusion = former.occlusion;
    if (former.latlong) latlong();
    if (former.pyramid) pyramid();
    if (former.prefiltered) prefiltered();
    if (former.harmonics) harmonics();
    if (former.chosen) {
        carrier();
        harmonics();  // what a change of the carrier may ask for
    }
    if (former.diffuseLights) diffuseLights();
    if (former.irradiance || _carrier.lights) irradiance();
    if (former.occlusionLights) occlusionList(former.occlusionLights);
    makeSunUniforms();
    exposure();
}

MapTextures::MapTextures(const MapTextures& former) = default;

osg::ref_ptr<MapTextures> MapTextures::dark()
{
    const int width = 64, height = 32;
    osg::ref_ptr<osg::Image> even = new osg::Image;
    even->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(even->data()), 3 * width * height, 1.0f);
    MapState state;
    state.image = even;
    state.layout = MapLayout::LATLONG;
    std::string error;
    osg::ref_ptr<MapTextures> textures = new MapTextures(state.read(error).get());
    textures->_scale = 0.0;
    return textures;
}

void MapTextures::settle()
{
    if (_diffuseLights || _irradiance) {
        _diffuse.settle(listed(), _diffuse.count(), _options);
        if (std::exchange(_diffuseLights, nullptr)) diffuseLights();
        if (std::exchange(_irradiance, nullptr)) irradiance();
    }
    if (_occlusionMade) {
        _occlusion.settle(listed(), _occlusion.count(), _options);
        _occlusionLights = nullptr;
    }
}

MapTextures::Continuation MapTextures::continuation(bool goesOn) const
{
    Continuation c;
    c.options = _options;
    c.latlong = _latlong.valid();
    c.pyramid = _pyramid.valid();
    c.prefiltered = _prefiltered.valid();
    c.harmonics = _harmonics.valid();
    c.chosen = _carrierMade;
    c.diffuseLights = _diffuseLights.valid();
    c.irradiance = _irradiance.valid();
    c.occlusionLights = _occlusionMade ? _occlusion.count() : 0;
    c.grid = _grid;
    if (!goesOn) return c;
    c.suns = _split.residual ? _split.suns : _formerSuns;
    c.carrier = _carrier;
    c.diffuse = _diffuse;
    c.occlusion = _occlusion;
    return c;
}

void MapTextures::use(const MapOptions& options)
{
    if (options.suns != _options.suns) {
        _split = SunSplit();
        _pyramid = nullptr;
        _prefiltered = nullptr;
        _harmonics = nullptr;
        _sunUniforms.clear();
    }
    if (!options.sameCarrier(_options)) {
        _carrier = DiffuseCarrier();
        _carrierMade = false;
        _diffuse = LightStream(LightStream::PLAIN);
        _diffuseMade = false;
        _diffuseLights = nullptr;
        _irradiance = nullptr;
    }
    if (!options.sameLists(_options)) {
        _occlusion = LightStream(LightStream::DEALT);
        _occlusionMade = false;
        _occlusionLights = nullptr;
    }
    _options = options;
}

const SunSplit& MapTextures::split()
{
    if (!_split.residual) _split = splitSuns(*_map, _options.suns == Settings::SUNS_OFF ? 0 : maximumSuns, _formerSuns);
    return _split;
}

const RadianceMap& MapTextures::residual()
{
    return *split().residual;
}

const DominantLights& MapTextures::suns()
{
    return split().suns;
}

const RadianceMap& MapTextures::listed()
{
    return _options.suns == Settings::SUNS_AUTO ? residual() : *_map;
}

SunShare MapTextures::sunShare()
{
    osg::Vec3d flux;
    for (const DominantLight& sun : suns()) flux += sun.flux;
    const osg::Vec3d ones(1, 1, 1);
    return {unsigned(suns().size()), _map->meanOfChannels() > 0.0 ? flux * ones / (_map->flux * ones) : 0.0};
}

void MapTextures::setFormat(osg::Texture2D& texture, osg::Image* image) const
{
    image->setInternalTextureFormat(_map->maximum * _scale < largestHalf ? GL_RGB16F_ARB : GL_RGB32F_ARB);
    texture.setImage(image);
    texture.setInternalFormat(image->getInternalTextureFormat());
    texture.setResizeNonPowerOfTwoHint(false);
    texture.setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture.setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture.setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture.setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
}

osg::ref_ptr<osg::Image> MapTextures::scaledMap() const
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(_map->width, _map->height, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < _map->height; ++y) {
        const float* in = _map->texel(0, y);
        float* out = reinterpret_cast<float*>(image->data(0, unsigned(y)));
        for (int i = 0; i < 3 * _map->width; ++i) out[i] = float(double(in[i]) * _scale);
    }
    return image;
}

osg::Texture2D* MapTextures::latlong()
{
    if (!_latlong) {
        _latlong = new osg::Texture2D;
        setFormat(*_latlong, scaledMap().get());
        _latlong->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    }
    return _latlong.get();
}

osg::Texture2D* MapTextures::pyramid()
{
    if (!_pyramid) {
        if (!_grid) _grid = std::make_shared<const OctahedralGrid>(_side);
        _pyramid = new osg::Texture2D;
        setFormat(*_pyramid, makePyramid(residual(), *_grid, _scale).get());
    }
    return _pyramid.get();
}

osg::Texture2D* MapTextures::prefiltered()
{
    if (!_prefiltered) {
        _prefiltered = new osg::Texture2D;
        setFormat(*_prefiltered, prefilterPyramid(*pyramid()->getImage(), _side).get());
    }
    return _prefiltered.get();
}

osg::Uniform* MapTextures::harmonics()
{
    if (!_harmonics) {
        _harmonics = new osg::Uniform(osg::Uniform::FLOAT_VEC3, "shCoefficients", 18);
        for (int i = 0; i < 18; ++i) {
            const osg::Vec3d c = listed().harmonics()[size_t(i)] * (cosineBand(harmonicBand(i)) / glsl::PI * _scale);
            _harmonics->setElement(unsigned(i), osg::Vec3f(c));
        }
    }
    return _harmonics.get();
}

const DiffuseCarrier& MapTextures::carrier()
{
    if (_carrierMade) return _carrier;
    _carrierMade = true;
    if (_options.given) {
        _carrier = {0, unsigned(_options.given->size()), -1.0, 0.0, true};
    } else if (_options.diffuseCarrier == Settings::SH) {
        _carrier = {18, 0, -1.0, 0.0, false};
    } else if (_options.diffuseCarrier == Settings::LIGHTS) {
        _carrier = {0, _options.diffuseLights, -1.0, 0.0, false};
    } else {
        // Of the counts that are tried, the former's goes on from its lights; the others start cold.
        const LightStream former = _diffuse;
        auto list = [&](unsigned count) -> const LightList& {
            _diffuse = former;
            _diffuseMade = true;
            return _diffuse.next(listed(), count, _options);
        };
        const DiffuseCarrier before = _carrier;
        _carrier = chooseCarrier(listed(), _options.diffuseError, _options.diffuseLights, list, &before);
        if (_carrier.lights && _diffuse.count() != _carrier.lights) list(_carrier.lights);
        if (!_carrier.lights) {
            _diffuse = former;
            _diffuseMade = false;
        }
    }
    return _carrier;
}

const LightList& MapTextures::diffuseList()
{
    const unsigned count = carrier().lights ? carrier().lights : _options.diffuseLights;
    if (!_diffuseMade || _diffuse.count() != count) {
        _diffuse.next(listed(), count, _options);
        _diffuseMade = true;
        _diffuseLights = nullptr;
        _irradiance = nullptr;
    }
    return _diffuse.lights();
}

osg::Texture2D* MapTextures::diffuseLights()
{
    // Rows of at most 4096 lights: a texture is narrower than the longest list. A map that is all suns has none.
    const LightList& list = diffuseList();
    const unsigned rows = std::max((unsigned(list.size()) + 4095) / 4096, 1u);
    if (!_diffuseLights) _diffuseLights = lightTexture(list, rows, _scale);
    return _diffuseLights.get();
}

osg::Texture2D* MapTextures::irradiance()
{
    const LightList& list = diffuseList();
    if (!_irradiance) _irradiance = irradianceTexture(list, _scale);
    return _irradiance.get();
}

const LightList& MapTextures::occlusionList(unsigned count)
{
    if (!_occlusionMade || _occlusion.count() != count) {
        _occlusion.next(listed(), count, _options);
        _occlusionMade = true;
        _occlusionLights = nullptr;
    }
    return _occlusion.lights();
}

osg::Texture2D* MapTextures::occlusionLights(unsigned count)
{
    occlusionList(count);
    if (!_occlusionLights) _occlusionLights = lightTexture(_occlusion.lights(), 16, _scale);
    return _occlusionLights.get();
}

double MapTextures::exposure()
{
    if (!_exposure) _exposure = mapExposure(*_map);
    return *_exposure;
}

void MapTextures::addSuns(std::vector<osg::ref_ptr<osg::Uniform>>& uniforms)
{
    if (_sunUniforms.empty()) makeSunUniforms();
    uniforms.insert(uniforms.end(), _sunUniforms.begin(), _sunUniforms.end());
}

void MapTextures::makeSunUniforms()
{
    osg::ref_ptr<osg::Uniform> count = new osg::Uniform("sunCount", int(suns().size()));
    osg::ref_ptr<osg::Uniform> direction = new osg::Uniform(osg::Uniform::FLOAT_VEC3, "sunDirection", maximumSuns);
    osg::ref_ptr<osg::Uniform> radiance = new osg::Uniform(osg::Uniform::FLOAT_VEC3, "sunRadiance", maximumSuns);
    osg::ref_ptr<osg::Uniform> radius = new osg::Uniform(osg::Uniform::FLOAT, "sunRadius", maximumSuns);
    for (unsigned i = 0; i < suns().size(); ++i) {
        const DominantLight& sun = suns()[i];
        const double sine = std::sin(sun.radius);
        direction->setElement(i, osg::Vec3f(sun.direction));
        // Of the disc that gives a surface facing it the flux as irradiance: pi sin^2 of its radius.
        radiance->setElement(i, osg::Vec3f(sun.flux * (_scale / (glsl::PI * sine * sine))));
        radius->setElement(i, float(sun.radius));
    }
    _sunUniforms = {count, direction, radiance, radius};
}

std::array<osg::Texture2D*, 6> MapTextures::textures() const
{
    return {_latlong.get(), _pyramid.get(), _prefiltered.get(), _diffuseLights.get(), _irradiance.get(), _occlusionLights.get()};
}

void MapTextures::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Texture2D* t : textures())
        if (t) t->resizeGLObjectBuffers(maximum);
}

void MapTextures::releaseGLObjects(osg::State* state) const
{
    for (const osg::Texture2D* t : textures())
        if (t) t->releaseGLObjects(state);
}

size_t MapTextures::bytes() const
{
    size_t sum = 0;
    for (const osg::Texture2D* t : {_latlong.get(), _pyramid.get(), _prefiltered.get()})
        if (t)
            sum += size_t(t->getImage()->s()) * size_t(t->getImage()->t()) * (t->getInternalFormat() == GL_RGB16F_ARB ? 6 : 12);
    for (const osg::Texture2D* t : {_diffuseLights.get(), _irradiance.get(), _occlusionLights.get()})
        if (t) sum += t->getImage()->getTotalSizeInBytes();
    return sum;
}

}  // namespace osgEnvLight
