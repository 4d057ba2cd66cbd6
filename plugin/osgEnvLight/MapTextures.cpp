// SPDX-License-Identifier: MIT
#include <osgEnvLight/MapTextures>

#include <osgEnvLight/AutoSampler>
#include <osgEnvLight/LightTexture>
#include <osgEnvLight/SphericalHarmonics>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double largestHalf = 65504.0;
const unsigned smallestLevel = 4;  // side of the pyramid's last level

// A level of the pyramid while it is made: texels and their solid angles.
struct Level {
    unsigned side;
    std::vector<osg::Vec3d> radiance;
    std::vector<double> solidAngle;

    explicit Level(unsigned s) : side(s), radiance(size_t(s) * s), solidAngle(size_t(s) * s) {}
    size_t index(unsigned x, unsigned y) const { return size_t(y) * side + x; }
};

osg::Vec3d mapBilinear(const RadianceMap& map, const glsl::vec2& uv)
{
    const double x = (uv.x - std::floor(uv.x)) * map.width - 0.5;
    const double y = std::clamp(uv.y * map.height - 0.5, 0.0, double(map.height - 1));
    const int x0 = int(std::floor(x));
    const int y0 = int(y);
    const double a = x - x0;
    const double b = y - y0;
    auto texel = [&](int i, int j) {
        const float* t = map.texel((i + map.width) % map.width, std::min(j, map.height - 1));
        return osg::Vec3d(t[0], t[1], t[2]);
    };
    return (texel(x0, y0) * (1 - a) + texel(x0 + 1, y0) * a) * (1 - b) +
           (texel(x0, y0 + 1) * (1 - a) + texel(x0 + 1, y0 + 1) * a) * b;
}

// The map's coordinates over one texel of the pyramid: exact at its corners and linear between them, which spares an arc
// tangent for each look-up; exact everywhere in the texels that hold a pole or straddle the fold or the seam.
class TexelCoordinates
{
  public:
    TexelCoordinates(unsigned x, unsigned y, unsigned side) : _x(x), _y(y), _side(side)
    {
        double low = 1.0;
        double high = 0.0;
        for (unsigned k = 0; k < 4; ++k) {
            _corner[k] = exact(k & 1, k >> 1);
            low = std::min(low, _corner[k].x);
            high = std::max(high, _corner[k].x);
        }
        _linear = high - low < 0.02 && onOneFace();
    }

    glsl::vec2 at(double s, double t) const
    {
        if (!_linear) return exact(s, t);
        return glsl::mix(glsl::mix(_corner[0], _corner[1], s), glsl::mix(_corner[2], _corner[3], s), t);
    }

    glsl::vec2 square(double s, double t) const { return glsl::vec2((_x + s) / _side, (_y + t) / _side); }

  private:
    glsl::vec2 exact(double s, double t) const { return glsl::latlongFromDirection(glsl::directionFromOctahedral(square(s, t))); }

    // The mapping has a kink where a face of the octahedron ends: on the axes and on the equator's diamond.
    bool onOneFace() const
    {
        const int half = int(_side) / 2;
        const int x = std::abs(2 * int(_x) + 1 - int(_side)) / 2;
        const int y = std::abs(2 * int(_y) + 1 - int(_side)) / 2;
        return x + y + 1 != half && x + y + 2 != half && x + y != half;
    }

    unsigned _x;
    unsigned _y;
    unsigned _side;
    glsl::vec2 _corner[4];
    bool _linear;
};

// Level 0: each texel averages as many look-ups as it covers texels of the map, at least 3 x 3, by solid angle.
Level baseLevel(const RadianceMap& map, unsigned side)
{
    Level level(side);
    const unsigned sub = std::max(3u, unsigned(map.width) / side);
    for (unsigned y = 0; y < side; ++y)
        for (unsigned x = 0; x < side; ++x) {
            const TexelCoordinates texel(x, y, side);
            osg::Vec3d sum;
            double weight = 0.0;
            for (unsigned j = 0; j < sub; ++j)
                for (unsigned i = 0; i < sub; ++i) {
                    const double s = (i + 0.5) / sub;
                    const double t = (j + 0.5) / sub;
                    const double w = glsl::octahedralSolidAngleDensity(texel.square(s, t));
                    sum += mapBilinear(map, texel.at(s, t)) * w;
                    weight += w;
                }
            level.radiance[level.index(x, y)] = sum / weight;
            level.solidAngle[level.index(x, y)] = weight;
        }
    return level;
}

Level nextLevel(const Level& fine)
{
    Level level(fine.side / 2);
    for (unsigned y = 0; y < level.side; ++y)
        for (unsigned x = 0; x < level.side; ++x) {
            osg::Vec3d sum;
            double weight = 0.0;
            for (unsigned k = 0; k < 4; ++k) {
                const size_t i = fine.index(2 * x + (k & 1), 2 * y + (k >> 1));
                sum += fine.radiance[i] * fine.solidAngle[i];
                weight += fine.solidAngle[i];
            }
            level.radiance[level.index(x, y)] = sum / weight;
            level.solidAngle[level.index(x, y)] = weight;
        }
    return level;
}

// The level into the atlas with its border: over an edge of the octahedral square lies the same edge, turned round.
void store(const Level& level, unsigned number, unsigned baseSide, double scale, osg::Image& atlas)
{
    const glsl::vec2 corner = glsl::pyramidLevelCorner(baseSide, number);
    const int s = int(level.side);
    for (int y = -1; y <= s; ++y)
        for (int x = -1; x <= s; ++x) {
            const bool overX = x < 0 || x >= s;
            const bool overY = y < 0 || y >= s;
            const int fx = overX ? std::clamp(x, 0, s - 1) : x;
            const int fy = overY ? std::clamp(y, 0, s - 1) : y;
            const int sx = overY ? s - 1 - fx : fx;
            const int sy = overX ? s - 1 - fy : fy;
            const osg::Vec3d c = level.radiance[level.index(unsigned(sx), unsigned(sy))] * scale;
            float* out = reinterpret_cast<float*>(atlas.data(unsigned(int(corner.x) + x + 1), unsigned(int(corner.y) + y + 1)));
            for (int k = 0; k < 3; ++k) out[k] = float(c[k]);
        }
}

// Half the map's width, which keeps the number of texels on the sphere, as a power of two within the atlas's limits.
unsigned sideFor(int width)
{
    unsigned side = smallestLevel;
    while (side < 1024 && int(2 * side) < width) side *= 2;
    return side;
}

}  // namespace

MapTextures::MapTextures(const RadianceMap* map)
    : _map(map), _scale(map->mean > 0.0 ? 1.0 / map->mean : 0.0), _side(sideFor(map->width))
{
}

unsigned MapTextures::pyramidLastLevel() const
{
    return unsigned(std::lround(std::log2(double(_side) / smallestLevel)));
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
    if (_pyramid) return _pyramid.get();
    osg::ref_ptr<osg::Image> atlas = new osg::Image;
    const unsigned last = pyramidLastLevel();
    atlas->allocateImage(int(_side + 2 + (last ? _side / 2 + 2 : 0)), int(_side + 2 + 2 * last), 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(atlas->data()), atlas->getTotalSizeInBytes() / sizeof(float), 0.0f);
    Level level = baseLevel(*_map, _side);
    for (unsigned i = 0;; ++i) {
        store(level, i, _side, _scale, *atlas);
        if (i == last) break;
        level = nextLevel(level);
    }
    _pyramid = new osg::Texture2D;
    setFormat(*_pyramid, atlas.get());
    return _pyramid.get();
}

osg::Uniform* MapTextures::harmonics()
{
    if (!_harmonics) {
        _harmonics = new osg::Uniform(osg::Uniform::FLOAT_VEC3, "shCoefficients", 18);
        for (int i = 0; i < 18; ++i) {
            const osg::Vec3d c = _map->harmonics()[size_t(i)] * (cosineBand(harmonicBand(i)) / glsl::PI * _scale);
            _harmonics->setElement(unsigned(i), osg::Vec3f(c));
        }
    }
    return _harmonics.get();
}

const LightList& MapTextures::diffuseList(unsigned count)
{
    if (_diffuseCount != count) {
        const osg::ref_ptr<const LightSampler> sampler = new AutoSampler;
        _diffuseCount = count;
        _diffuseList = sampler->sample(*_map, count);
        _diffuseLights = nullptr;
        _carrier = DiffuseCarrier();
    }
    return _diffuseList;
}

osg::Texture2D* MapTextures::diffuseLights(unsigned count)
{
    const LightList& lights = diffuseList(count);
    // Rows of at most 4096 lights: a texture is narrower than the longest list.
    if (!_diffuseLights) _diffuseLights = lightTexture(lights, (count + 4095) / 4096, _scale);
    return _diffuseLights.get();
}

const DiffuseCarrier& MapTextures::carrier(unsigned count)
{
    const LightList& lights = diffuseList(count);
    if (_carrier.lightsError < 0.0) _carrier = chooseCarrier(*_map, lights);
    return _carrier;
}

osg::Texture2D* MapTextures::occlusionLights(unsigned count)
{
    if (!_occlusionLights || _occlusionCount != count) {
        osg::ref_ptr<const LightSampler> sampler = new AutoSampler;
        _occlusionCount = count;
        _occlusionLights = lightTexture(dealt(sampler->sample(*_map, count)), 16, _scale);
    }
    return _occlusionLights.get();
}

void MapTextures::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Texture2D* t : {_latlong.get(), _pyramid.get(), _diffuseLights.get(), _occlusionLights.get()})
        if (t) t->resizeGLObjectBuffers(maximum);
}

void MapTextures::releaseGLObjects(osg::State* state) const
{
    for (const osg::Texture2D* t : {_latlong.get(), _pyramid.get(), _diffuseLights.get(), _occlusionLights.get()})
        if (t) t->releaseGLObjects(state);
}

size_t MapTextures::bytes() const
{
    size_t sum = 0;
    for (const osg::Texture2D* t : {_latlong.get(), _pyramid.get()})
        if (t)
            sum += size_t(t->getImage()->s()) * size_t(t->getImage()->t()) * (t->getInternalFormat() == GL_RGB16F_ARB ? 6 : 12);
    for (const osg::Texture2D* t : {_diffuseLights.get(), _occlusionLights.get()})
        if (t) sum += t->getImage()->getTotalSizeInBytes();
    return sum;
}

}  // namespace osgEnvLight
