// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightTexels>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const int side = 8;  // of the blocks that findNearest() prunes directions for

osg::Vec3d centroid(const Moments& m, const osg::Vec3d& otherwise)
{
    const double length = m.vector.length();
    return m.flux > 0.0 && length > 1e-12 * m.flux ? m.vector / length : otherwise / otherwise.length();
}

// Directions by coordinate.
struct Columns {
    std::vector<float> x, y, z;

    void add(float dx, float dy, float dz)
    {
        x.push_back(dx);
        y.push_back(dy);
        z.push_back(dz);
    }
    void clear()
    {
        x.clear();
        y.clear();
        z.clear();
    }
    // Squared chords to a direction.
    void chords(float dx, float dy, float dz, std::vector<float>& result) const
    {
        result.resize(x.size());
        for (size_t i = 0; i < x.size(); ++i) {
            const float a = x[i] - dx;
            const float b = y[i] - dy;
            const float c = z[i] - dz;
            result[i] = a * a + b * b + c * c;
        }
    }
};

// Assigns the texels of one block after the other.
class NearestFinder
{
  public:
    NearestFinder(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& directions, size_t first)
        : _texels(texels), _group(group), _first(first)
    {
        for (size_t k = first; k < directions.size(); ++k)
            _all.add(float(directions[k].x()), float(directions[k].y()), float(directions[k].z()));
    }

    void assignBlock(int x0, int y0, std::vector<unsigned>& nearest)
    {
        _members.clear();
        for (int y = y0; y < std::min(y0 + side, _texels.height()); ++y)
            for (int x = x0; x < std::min(x0 + side, _texels.width()); ++x) {
                const size_t i = size_t(y) * size_t(_texels.width()) + size_t(x);
                if (_group.has(i)) _members.push_back(i);
            }
        if (_members.empty()) return;
        findCandidates();
        for (size_t i : _members) {
            _near.chords(_texels.x()[i], _texels.y()[i], _texels.z()[i], _chords);
            nearest[i] = _candidates[size_t(std::min_element(_chords.begin(), _chords.end()) - _chords.begin())];
        }
    }

  private:
    // Nothing farther from one texel of the block than the nearest to it by more than two radii can be near another.
    void findCandidates()
    {
        const osg::Vec3d c = _texels.direction(_members[_members.size() / 2]);
        double radius2 = 0.0;
        for (size_t i : _members) radius2 = std::max(radius2, (_texels.direction(i) - c).length2());
        _all.chords(float(c.x()), float(c.y()), float(c.z()), _chords);
        const double least = double(*std::min_element(_chords.begin(), _chords.end()));
        const double limit = std::sqrt(least) + 2.0 * std::sqrt(radius2) + 1e-5;
        const float limit2 = float(limit * limit);
        _near.clear();
        _candidates.clear();
        for (size_t k = 0; k < _chords.size(); ++k) {
            if (_chords[k] > limit2) continue;
            _candidates.push_back(unsigned(_first + k));
            _near.add(_all.x[k], _all.y[k], _all.z[k]);
        }
    }

    const LightTexels& _texels;
    const TexelGroup& _group;
    size_t _first;
    Columns _all;
    Columns _near;
    std::vector<float> _chords;
    std::vector<unsigned> _candidates;
    std::vector<size_t> _members;
};

}  // namespace

LightTexels::LightTexels(const RadianceMap& map, int columns, double floor) : _floor(floor * map.meanOfChannels())
{
    const int block = (map.width + columns - 1) / columns;
    const int repeatX = map.width < 64 ? (63 + map.width) / map.width : 1;
    const int repeatY = map.height < 32 ? (31 + map.height) / map.height : 1;
    _width = (map.width * repeatX + block - 1) / block;
    _height = (map.height * repeatY + block - 1) / block;
    _light.resize(size_t(_width) * size_t(_height));
    _solidAngle.assign(size_t(_height), 0.0);
    const glsl::vec2 scale(double(block) / (map.width * repeatX), double(block) / (map.height * repeatY));
    for (std::vector<float>* v : {&_x, &_y, &_z}) v->reserve(_light.size());
    for (int y = 0; y < _height; ++y)
        for (int x = 0; x < _width; ++x) {
            const glsl::vec3 d = glsl::directionFromLatlong(glsl::min((glsl::vec2(x, y) + 0.5) * scale, glsl::vec2(1.0)));
            _x.push_back(float(d.x));
            _y.push_back(float(d.y));
            _z.push_back(float(d.z));
        }
    sumBlocks(map, block, repeatX, repeatY);
    for (size_t i = 0; i < size(); ++i) _lit += deciding(i) > 0.0;
}

void LightTexels::sumBlocks(const RadianceMap& map, int block, int repeatX, int repeatY)
{
    const int fineWidth = map.width * repeatX;
    const int fineHeight = map.height * repeatY;
    const glsl::vec2 size(fineWidth, fineHeight);
    std::vector<osg::Vec2d> azimuth(static_cast<size_t>(fineWidth));
    for (int x = 0; x < fineWidth; ++x) {
        const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / size.x, 0.5));
        azimuth[size_t(x)].set(d.x, d.y);
    }
    for (int y = 0; y < fineHeight; ++y) {
        const double solidAngle = glsl::latlongTexelSolidAngle(y, size);
        const double theta = glsl::PI * (y + 0.5) / size.y;
        const osg::Vec2d polar = osg::Vec2d(std::sin(theta), std::cos(theta)) * (solidAngle / 3.0);
        _solidAngle[size_t(y / block)] += solidAngle * block;
        for (int bx = 0; bx < _width; ++bx) {
            osg::Vec3d rgb;
            osg::Vec2d around;
            for (int x = bx * block; x < std::min((bx + 1) * block, fineWidth); ++x) {
                const float* t = map.texel(x / repeatX, y / repeatY);
                const osg::Vec3d c = osg::Vec3f(t[0], t[1], t[2]);
                rgb += c;
                around += azimuth[size_t(x)] * (c[0] + c[1] + c[2]);
            }
            Moments& m = _light[size_t(y / block) * size_t(_width) + size_t(bx)];
            const double sum = rgb[0] + rgb[1] + rgb[2];
            m.flux += sum * solidAngle / 3.0;
            m.vector += osg::Vec3d(around[0] * polar[0], around[1] * polar[0], sum * polar[1]);
            m.rgb += rgb * solidAngle;
        }
    }
}

LightList LightTexels::lights() const
{
    LightList list;
    list.reserve(_lit);
    for (size_t i = 0; i < size(); ++i)
        if (deciding(i) > 0.0) list.push_back({centroid(_light[i], direction(i)), _light[i].rgb});
    return list;
}

void findNearest(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& directions, size_t first,
                 std::vector<unsigned>& nearest)
{
    if (directions.size() <= first) return;
    NearestFinder finder(texels, group, directions, first);
    for (int y = 0; y < texels.height(); y += side)
        for (int x = 0; x < texels.width(); x += side) finder.assignBlock(x, y, nearest);
}

LightList gatherLights(const LightTexels& texels, const std::vector<unsigned>& owner, const std::vector<osg::Vec3d>& directions)
{
    std::vector<Moments> sums(directions.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        const Moments& m = texels.light(i);
        if (!(m.flux > 0.0)) continue;
        sums[owner[i]].flux += m.flux;
        sums[owner[i]].vector += m.vector;
        sums[owner[i]].rgb += m.rgb;
    }
    LightList lights;
    lights.reserve(directions.size());
    for (size_t k = 0; k < sums.size(); ++k) lights.push_back({centroid(sums[k], directions[k]), sums[k].rgb});
    return lights;
}

}  // namespace osgEnvLight
