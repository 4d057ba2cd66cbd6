// SPDX-License-Identifier: MIT
#include "environment/MapPyramid.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const unsigned smallestLevel = 4;  // side of the last level

struct Rgb {
    float r, g, b;
};

// A level of the pyramid while it is made: texels and their solid angles.
struct Level {
    unsigned side;
    std::vector<Rgb> radiance;
    std::vector<float> solidAngle;

    explicit Level(unsigned s) : side(s), radiance(size_t(s) * s), solidAngle(size_t(s) * s) {}
    size_t index(unsigned x, unsigned y) const { return size_t(y) * side + x; }
};

// The map read bilinearly.
class BilinearMap
{
  public:
    explicit BilinearMap(const RadianceMap& map) : _map(map) {}

    /** At texel coordinates (0, 0) .. (width, height), x wrapping by at most one turn. */
    void add(float u, float v, float share, Rgb& sum) const
    {
        float x = u - 0.5f;
        if (x < 0.0f) x += float(_map.width);
        const float y = std::clamp(v - 0.5f, 0.0f, float(_map.height - 1));
        int x0 = int(x);
        const float a = x - float(x0);
        if (x0 >= _map.width) x0 -= _map.width;
        const int x1 = x0 + 1 == _map.width ? 0 : x0 + 1;
        const int y0 = int(y);
        const int y1 = std::min(y0 + 1, _map.height - 1);
        const float b = (y - float(y0)) * share;
        const float t = share - b;
        add(_map.texel(0, y0), x0, x1, t - t * a, t * a, sum);
        add(_map.texel(0, y1), x0, x1, b - b * a, b * a, sum);
    }

  private:
    static void add(const float* row, int x0, int x1, float w0, float w1, Rgb& sum)
    {
        const float* t0 = row + 3 * x0;
        const float* t1 = row + 3 * x1;
        sum.r += w0 * t0[0] + w1 * t1[0];
        sum.g += w0 * t0[1] + w1 * t1[1];
        sum.b += w0 * t0[2] + w1 * t1[2];
    }

    const RadianceMap& _map;
};

osg::Vec2d exactCoordinates(double s, double t, unsigned side)
{
    const glsl::vec2 uv = glsl::latlongFromDirection(glsl::directionFromOctahedral(glsl::vec2(s, t) / double(side)));
    return osg::Vec2d(uv.x, uv.y);
}

// The mapping has a kink where a face of the octahedron ends: on the axes and on the equator's diamond.
bool onOneFace(unsigned x, unsigned y, unsigned side)
{
    const int half = int(side) / 2;
    const int i = std::abs(2 * int(x) + 1 - int(side)) / 2;
    const int j = std::abs(2 * int(y) + 1 - int(side)) / 2;
    return i + j + 1 != half && i + j + 2 != half && i + j != half;
}

// The map's coordinates over one texel: exact at its corners and linear between them, which spares an arc tangent for each
// look-up; exact everywhere in the texels that hold a pole or straddle the fold or the seam.
class TexelCoordinates
{
  public:
    TexelCoordinates(const OctahedralGrid& grid, unsigned x, unsigned y)
        : _x(x),
          _y(y),
          _side(grid.side()),
          _corner{grid.corner(x, y), grid.corner(x + 1, y), grid.corner(x, y + 1), grid.corner(x + 1, y + 1)}
    {
        const auto [low, high] = std::minmax({_corner[0].x(), _corner[1].x(), _corner[2].x(), _corner[3].x()});
        _linear = high - low < 0.02 && onOneFace(x, y, _side);
    }

    /** Averages as many look-ups across as it is wide in texels of the map, from 2 to 8 (more only where the whole map is so
     * much finer), 4 where it is not linear.*/
    Rgb mean(const BilinearMap& map, float width, float height) const
    {
        Rgb sum{0.0f, 0.0f, 0.0f};
        const unsigned most = std::max(8u, unsigned(width) / _side);
        osg::Vec2f corner[4];
        for (int k = 0; k < 4; ++k) corner[k].set(float(_corner[k].x()) * width, float(_corner[k].y()) * height);
        const float extent = std::max((corner[3] - corner[0]).length(), (corner[2] - corner[1]).length());
        const unsigned sub = _linear ? std::clamp(unsigned(std::ceil(0.75f * extent)), 2u, most) : std::max(4u, most / 2);
        const float share = 1.0f / float(sub * sub);
        for (unsigned j = 0; j < sub; ++j) {
            const float t = (float(j) + 0.5f) / float(sub);
            const osg::Vec2f left = corner[0] + (corner[2] - corner[0]) * t;
            const osg::Vec2f across = corner[1] + (corner[3] - corner[1]) * t - left;
            for (unsigned i = 0; i < sub; ++i) {
                const float s = (float(i) + 0.5f) / float(sub);
                if (_linear) {
                    map.add(left.x() + across.x() * s, left.y() + across.y() * s, share, sum);
                } else {
                    const osg::Vec2d uv = exactCoordinates(_x + double(s), _y + double(t), _side);
                    map.add(float(uv.x()) * width, float(uv.y()) * height, share, sum);
                }
            }
        }
        return sum;
    }

  private:
    unsigned _x;
    unsigned _y;
    unsigned _side;
    osg::Vec2d _corner[4];
    bool _linear;
};

// Level 0: each texel averages as many look-ups as it covers texels of the map. Solid angle changes by less
// than 3 / side over a texel and evenly: one weight for all of them is right to second order.
Level baseLevel(const RadianceMap& map, const OctahedralGrid& grid)
{
    Level level(grid.side());
    const BilinearMap bilinear(map);
    for (unsigned y = 0; y < level.side; ++y)
        for (unsigned x = 0; x < level.side; ++x) {
            level.radiance[level.index(x, y)] = TexelCoordinates(grid, x, y).mean(bilinear, float(map.width), float(map.height));
            level.solidAngle[level.index(x, y)] =
                float(glsl::octahedralSolidAngleDensity((glsl::vec2(x, y) + 0.5) / double(level.side)));
        }
    return level;
}

Level nextLevel(const Level& fine)
{
    Level level(fine.side / 2);
    for (unsigned y = 0; y < level.side; ++y)
        for (unsigned x = 0; x < level.side; ++x) {
            const size_t first[2] = {fine.index(2 * x, 2 * y), fine.index(2 * x, 2 * y + 1)};
            const float* w[2] = {&fine.solidAngle[first[0]], &fine.solidAngle[first[1]]};
            const float weight = w[0][0] + w[0][1] + w[1][0] + w[1][1];
            Rgb sum{0.0f, 0.0f, 0.0f};
            for (unsigned k = 0; k < 4; ++k) {
                const Rgb& c = fine.radiance[first[k >> 1] + (k & 1)];
                const float share = w[k >> 1][k & 1] / weight;  // first: radiance may be near the largest float
                sum.r += c.r * share;
                sum.g += c.g * share;
                sum.b += c.b * share;
            }
            level.radiance[level.index(x, y)] = sum;
            level.solidAngle[level.index(x, y)] = weight;
        }
    return level;
}

// The level into the atlas with its border: over an edge of the octahedral square lies the same edge, turned round.
void store(const Level& level, unsigned number, unsigned baseSide, double scale, osg::Image& atlas)
{
    const glsl::vec2 corner = glsl::pyramidLevelCorner(baseSide, number);
    const int s = int(level.side);
    for (int y = -1; y <= s; ++y) {
        float* out = reinterpret_cast<float*>(atlas.data(unsigned(int(corner.x)), unsigned(int(corner.y) + y + 1)));
        for (int x = -1; x <= s; ++x, out += 3) {
            const glsl::ivec2 p = glsl::foldedTexel(glsl::ivec2(x, y), s);
            const Rgb& c = level.radiance[level.index(unsigned(p.x), unsigned(p.y))];
            out[0] = float(double(c.r) * scale);
            out[1] = float(double(c.g) * scale);
            out[2] = float(double(c.b) * scale);
        }
    }
}

}  // namespace

OctahedralGrid::OctahedralGrid(unsigned side) : _side(side), _corners(size_t(side + 1) * (side + 1))
{
    for (unsigned y = 0; y <= side; ++y)
        for (unsigned x = 0; x <= side; ++x) _corners[size_t(y) * (side + 1) + x] = exactCoordinates(x, y, side);
}

unsigned pyramidSide(int mapWidth)
{
    unsigned side = smallestLevel;
    while (side < 1024 && int(2 * side) < mapWidth) side *= 2;
    return side;
}

unsigned pyramidLastLevel(unsigned side)
{
    return unsigned(std::lround(std::log2(double(side) / smallestLevel)));
}

osg::ref_ptr<osg::Image> makePyramid(const RadianceMap& map, const OctahedralGrid& grid, double scale)
{
    const unsigned side = grid.side();
    const unsigned last = pyramidLastLevel(side);
    osg::ref_ptr<osg::Image> atlas = new osg::Image;
    atlas->allocateImage(int(side + 2 + (last ? side / 2 + 2 : 0)), int(side + 2 + 2 * last), 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(atlas->data()), atlas->getTotalSizeInBytes() / sizeof(float), 0.0f);
    Level level = baseLevel(map, grid);
    for (unsigned i = 0;; ++i) {
        store(level, i, side, scale, *atlas);
        if (i == last) break;
        level = nextLevel(level);
    }
    return atlas;
}

}  // namespace osgEnvLight
