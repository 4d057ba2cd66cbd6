// SPDX-License-Identifier: MIT
#include "lights/LightTexels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Of the blocks that findNearest() narrows the directions for, first of the large, then of the small.
const int largeSide = 64;
const int smallSide = 8;

osg::Vec2d azimuthAt(double u)
{
    const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2(u, 0.5));
    return osg::Vec2d(d.x, d.y);
}

// In two steps that compilers turn into vector instructions; std::min_element's one they don't.
size_t indexOfLeast(const std::vector<float>& v)
{
    std::array<float, 8> least;
    least.fill(v[0]);
    const size_t whole = v.size() / least.size() * least.size();
    for (size_t i = 0; i < whole; i += least.size())
        for (size_t k = 0; k < least.size(); ++k) least[k] = v[i + k] < least[k] ? v[i + k] : least[k];
    for (size_t i = whole; i < v.size(); ++i) least[0] = std::min(v[i], least[0]);
    return size_t(std::find(v.begin(), v.end(), *std::min_element(least.begin(), least.end())) - v.begin());
}

// Some of the directions, by coordinate.
struct Candidates {
    std::vector<float> x, y, z;
    std::vector<unsigned> index;

    void add(float dx, float dy, float dz, unsigned i)
    {
        x.push_back(dx);
        y.push_back(dy);
        z.push_back(dz);
        index.push_back(i);
    }
    void clear()
    {
        for (std::vector<float>* v : {&x, &y, &z}) v->clear();
        index.clear();
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
        : _texels(texels), _group(group)
    {
        for (size_t k = first; k < directions.size(); ++k)
            _all.add(float(directions[k].x()), float(directions[k].y()), float(directions[k].z()), unsigned(k));
    }

    void assignLarge(int x0, int y0, std::vector<unsigned>& nearest)
    {
        if (!findMembers(x0, y0, largeSide)) return;
        narrow(_all, _large);
        for (int y = y0; y < std::min(y0 + largeSide, _texels.height()); y += smallSide)
            for (int x = x0; x < std::min(x0 + largeSide, _texels.width()); x += smallSide) assignSmall(x, y, nearest);
    }

  private:
    void assignSmall(int x0, int y0, std::vector<unsigned>& nearest)
    {
        if (!findMembers(x0, y0, smallSide)) return;
        narrow(_large, _small);
        for (size_t i : _members) {
            _small.chords(_texels.x()[i], _texels.y()[i], _texels.z()[i], _chords);
            nearest[i] = _small.index[indexOfLeast(_chords)];
        }
    }

    bool findMembers(int x0, int y0, int side)
    {
        _members.clear();
        for (int y = y0; y < std::min(y0 + side, _texels.height()); ++y)
            for (int x = x0; x < std::min(x0 + side, _texels.width()); ++x) {
                const size_t i = size_t(y) * size_t(_texels.width()) + size_t(x);
                if (_group.has(i)) _members.push_back(i);
            }
        return !_members.empty();
    }

    // Nothing farther from one member than what is nearest to it by more than two radii can be nearest to another.
    void narrow(const Candidates& from, Candidates& to)
    {
        const osg::Vec3d c = _texels.direction(_members[_members.size() / 2]);
        double radius2 = 0.0;
        for (size_t i : _members) radius2 = std::max(radius2, (_texels.direction(i) - c).length2());
        from.chords(float(c.x()), float(c.y()), float(c.z()), _chords);
        const double least = double(_chords[indexOfLeast(_chords)]);
        const double limit = std::sqrt(least) + 2.0 * std::sqrt(radius2) + 1e-5;
        const float limit2 = float(limit * limit);
        to.clear();
        for (size_t k = 0; k < _chords.size(); ++k)
            if (_chords[k] <= limit2) to.add(from.x[k], from.y[k], from.z[k], from.index[k]);
    }

    const LightTexels& _texels;
    const TexelGroup& _group;
    Candidates _all, _large, _small;
    std::vector<float> _chords;
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
    _solidAngle.resize(_light.size());
    const glsl::vec2 scale(double(block) / (map.width * repeatX), double(block) / (map.height * repeatY));
    std::vector<osg::Vec2d> azimuth;
    for (int x = 0; x < _width; ++x) azimuth.push_back(azimuthAt(std::min((x + 0.5) * scale.x, 1.0)));
    for (std::vector<float>* v : {&_x, &_y, &_z}) v->reserve(_light.size());
    for (int y = 0; y < _height; ++y) {
        const double theta = glsl::PI * std::min((y + 0.5) * scale.y, 1.0);
        const osg::Vec2d polar(std::sin(theta), std::cos(theta));
        for (const osg::Vec2d& a : azimuth) {
            _x.push_back(float(polar.x() * a.x()));
            _y.push_back(float(polar.x() * a.y()));
            _z.push_back(float(polar.y()));
        }
    }
    sumBlocks(map, block, repeatX, repeatY);
    for (size_t i = 0; i < size(); ++i) _lit += deciding(i) > 0.0;
}

void LightTexels::sumBlocks(const RadianceMap& map, int block, int repeatX, int repeatY)
{
    const int fineWidth = map.width * repeatX;
    const int fineHeight = map.height * repeatY;
    const glsl::vec2 size(fineWidth, fineHeight);
    std::vector<osg::Vec2d> azimuth;
    for (int x = 0; x < fineWidth; ++x) azimuth.push_back(azimuthAt((x + 0.5) / fineWidth));
    for (int y = 0; y < fineHeight; ++y) {
        const double solidAngle = glsl::latlongTexelSolidAngle(y, size);
        const double theta = glsl::PI * (y + 0.5) / size.y;
        const osg::Vec2d polar = osg::Vec2d(std::sin(theta), std::cos(theta)) * (solidAngle / 3.0);
        for (int bx = 0; bx < _width; ++bx) {
            osg::Vec3d rgb;
            osg::Vec2d around;
            for (int x = bx * block; x < std::min((bx + 1) * block, fineWidth); ++x) {
                const float* t = map.texel(x / repeatX, y / repeatY);
                const osg::Vec3d c = osg::Vec3f(t[0], t[1], t[2]);
                rgb += c;
                around += azimuth[size_t(x)] * (c[0] + c[1] + c[2]);
            }
            const size_t i = size_t(y / block) * size_t(_width) + size_t(bx);
            _solidAngle[i] += solidAngle * (std::min((bx + 1) * block, fineWidth) - bx * block);
            Moments& m = _light[i];
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
        if (deciding(i) > 0.0) list.push_back({_light[i].centroid(direction(i)), _light[i].rgb});
    return list;
}

void findNearest(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& directions, size_t first,
                 std::vector<unsigned>& nearest)
{
    if (directions.size() <= first) return;
    NearestFinder finder(texels, group, directions, first);
    for (int y = 0; y < texels.height(); y += largeSide)
        for (int x = 0; x < texels.width(); x += largeSide) finder.assignLarge(x, y, nearest);
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
    for (size_t k = 0; k < sums.size(); ++k) lights.push_back({sums[k].centroid(directions[k]), sums[k].rgb});
    return lights;
}

}  // namespace osgEnvLight
