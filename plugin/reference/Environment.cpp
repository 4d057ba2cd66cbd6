// SPDX-License-Identifier: MIT
#include <reference/Environment>

#include "Directions.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const double evenly = 1.0 / (4.0 * pi);

void appendGuide(const double* sums, size_t n, std::vector<std::uint32_t>& guide)
{
    size_t first = 0;
    for (size_t k = 0; k < n; ++k) {
        while (first + 1 < n && sums[first] <= double(k) / double(n) * sums[n - 1]) ++first;
        guide.push_back(std::uint32_t(first));
    }
}

// The first of the sums above that share of the last, u in [0,1).
size_t firstAbove(const double* sums, size_t n, const std::uint32_t* guide, double u)
{
    const double value = u * sums[n - 1];
    size_t i = guide[std::min(size_t(u * double(n)), n - 1)];
    while (i > 0 && sums[i - 1] > value) --i;  // where u n was rounded up
    while (i + 1 < n && sums[i] <= value) ++i;
    return i;
}

// How far a value lies between the sum before and that one, 0 to 1.
double within(const double* sums, size_t i, double value)
{
    const double before = i > 0 ? sums[i - 1] : 0.0;
    return std::clamp((value - before) / std::max(sums[i] - before, 1e-300), 0.0, 1.0);
}

}  // namespace

void Environment::fromEach(const std::vector<glm::dvec3>& directions, bool withDensity, std::vector<Incident>& result) const
{
    result.clear();
    for (const glm::dvec3& d : directions) result.push_back(from(d, withDensity));
}

void Environment::sampleEach(const std::vector<glm::dvec2>& u, std::vector<Incident>& result) const
{
    result.clear();
    for (const glm::dvec2& v : u) result.push_back(sample(v));
}

MapEnvironment::MapEnvironment(const RadianceMap& map, double rotation, double intensity)
    : _map(&map),
      _cos(std::cos(osg::DegreesToRadians(rotation))),
      _sin(std::sin(osg::DegreesToRadians(rotation))),
      _intensity(intensity),
      _width(map.width),
      _height(map.height),
      _texels(reinterpret_cast<const glm::vec3*>(map.image->data()))
{
    makeTables();
}

glm::dvec3 MapEnvironment::turned(const glm::dvec3& d, double sine) const
{
    return {_cos * d.x - sine * d.y, sine * d.x + _cos * d.y, d.z};
}

// From the top, +Z; beyond it the outermost.
const glm::vec3* MapEnvironment::row(int y) const
{
    return _texels + size_t(_height - 1 - std::clamp(y, 0, _height - 1)) * size_t(_width);
}

// Column and row are not below -1: what is cut off is what floor() would, without a call.
void MapEnvironment::place(double column, double row, Place& place) const
{
    const int left = std::min(int(column + 1.0) - 1, _width - 1);
    const int top = int(row + 1.0) - 1;
    const int x0 = left < 0 ? left + _width : left;
    const int x1 = left + 1 < _width ? left + 1 : 0;
    const glm::vec3 *upper = this->row(top), *lower = this->row(top + 1);
    place.texels[0] = upper + x0;
    place.texels[1] = upper + x1;
    place.texels[2] = lower + x0;
    place.texels[3] = lower + x1;
    place.x = float(column - left);
    place.y = float(row - top);
}

glm::dvec3 MapEnvironment::bilinear(const Place& p) const
{
    return _intensity * glm::dvec3((1.0f - p.y) * ((1.0f - p.x) * *p.texels[0] + p.x * *p.texels[1]) +
                                   p.y * ((1.0f - p.x) * *p.texels[2] + p.x * *p.texels[3]));
}

void MapEnvironment::makeTables()
{
    const double step = pi / _height;
    for (int y = 0; y <= _height; ++y) _rowCosine.push_back(std::cos(y * step));
    for (size_t y = 0; y < size_t(_height); ++y) _solidAngle.push_back(2.0 * pi / _width * (_rowCosine[y] - _rowCosine[y + 1]));
    // The mean of the bilinear function over a texel weights it and its neighbours 6/8 and 1/8, along either axis.
    const double weights[3] = {0.125, 0.75, 0.125};
    _columnSums.reserve(size_t(_width) * size_t(_height));
    double rows = 0.0;
    for (int y = 0; y < _height; ++y) {
        double columns = 0.0;
        for (int x = 0; x < _width; ++x) {
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) {
                    const glm::dvec3 c = row(y + j - 1)[(x + i - 1 + _width) % _width];
                    columns += weights[i] * weights[j] * (c.r + c.g + c.b) * _solidAngle[size_t(y)];
                }
            _columnSums.push_back(columns);
        }
        _rowSums.push_back(rows += columns);
        appendGuide(&_columnSums[size_t(y) * size_t(_width)], size_t(_width), _columnGuides);
    }
    appendGuide(_rowSums.data(), size_t(_height), _rowGuide);
    if (!(rows > 0.0)) {
        _columnSums.clear();
        _rowSums.clear();
    }
}

double MapEnvironment::texelDensity(int x, int y) const
{
    if (_rowSums.empty()) return evenly;
    const double* sums = &_columnSums[size_t(y) * size_t(_width)];
    return (sums[x] - (x > 0 ? sums[x - 1] : 0.0)) / (_rowSums.back() * _solidAngle[size_t(y)]);
}

// What they find is written where it is kept: copies of what was just written wait for it.
// In the architecture's words: top row +Z, the centre along +X, columns clockwise seen from above.
void MapEnvironment::locate(const glm::dvec3& direction, bool withDensity, Place& place, Incident& in) const
{
    const glm::dvec3 d = turned(direction, -_sin);
    const double column = (0.5 - turnOf(d.y, d.x)) * _width;
    const double row = 2.0 * turnOf(std::sqrt(d.x * d.x + d.y * d.y), d.z) * _height;
    this->place(column - 0.5, row - 0.5, place);
    in.direction = direction;
    in.density = 0.0;
    if (withDensity) in.density = texelDensity(std::clamp(int(column), 0, _width - 1), std::clamp(int(row), 0, _height - 1));
}

void MapEnvironment::aim(const glm::dvec2& u, Place& place, Incident& in) const
{
    if (_rowSums.empty()) return locate(aboutPole(1.0 - 2.0 * u.x, u.y), true, place, in);
    // The random numbers are used up digit by digit: what is left of one places the point within its row or texel.
    const auto width = size_t(_width);
    const size_t y = firstAbove(_rowSums.data(), size_t(_height), _rowGuide.data(), u.y);
    const double v = within(_rowSums.data(), y, u.y * _rowSums.back());
    const double* sums = &_columnSums[y * width];
    const size_t x = firstAbove(sums, width, &_columnGuides[y * width], u.x);
    const double column = double(x) + within(sums, x, u.x * sums[width - 1]);
    const double z = _rowCosine[y] + v * (_rowCosine[y + 1] - _rowCosine[y]);  // evenly in solid angle
    const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
    this->place(column - 0.5, 2.0 * turnOf(s, z) * _height - 0.5, place);
    in.direction = turned(aboutPole(z, 0.5 - column / _width), _sin);
    in.density = texelDensity(int(x), int(y));
}

Incident MapEnvironment::from(const glm::dvec3& direction, bool withDensity) const
{
    Place place;
    Incident in;
    locate(direction, withDensity, place, in);
    in.radiance = bilinear(place);
    return in;
}

Incident MapEnvironment::sample(const glm::dvec2& u) const
{
    Place place;
    Incident in;
    aim(u, place, in);
    in.radiance = bilinear(place);
    return in;
}

// The texels are anywhere in the map: they are asked for together and waited for once.
template <class From>
void MapEnvironment::each(size_t count, std::vector<Incident>& result, const From& from) const
{
    result.resize(count);
    Place places[16];
    for (size_t first = 0; first < count; first += 16) {
        const size_t n = std::min<size_t>(16, count - first);
        for (size_t i = 0; i < n; ++i) {
            from(first + i, places[i], result[first + i]);
            __builtin_prefetch(places[i].texels[0]);
            __builtin_prefetch(places[i].texels[2]);
        }
        for (size_t i = 0; i < n; ++i) result[first + i].radiance = bilinear(places[i]);
    }
}

void MapEnvironment::fromEach(const std::vector<glm::dvec3>& directions, bool withDensity, std::vector<Incident>& result) const
{
    each(directions.size(), result, [&](size_t i, Place& place, Incident& in) { locate(directions[i], withDensity, place, in); });
}

void MapEnvironment::sampleEach(const std::vector<glm::dvec2>& u, std::vector<Incident>& result) const
{
    each(u.size(), result, [&](size_t i, Place& place, Incident& in) { aim(u[i], place, in); });
}

SunEnvironment::SunEnvironment(const DominantLights& suns, double rotation, double intensity)
{
    const double c = std::cos(osg::DegreesToRadians(rotation));
    const double s = std::sin(osg::DegreesToRadians(rotation));
    double total = 0.0;
    for (const DominantLight& sun : suns) {
        const osg::Vec3d& d = sun.direction;
        const double half = std::sin(0.5 * std::max(sun.radius, 1e-6));
        const double height = 2.0 * half * half;
        const double power = sun.flux[0] + sun.flux[1] + sun.flux[2];
        const double scale = intensity / (2.0 * pi * height);
        _discs.push_back({{c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z()},
                          scale * glm::dvec3(sun.flux[0], sun.flux[1], sun.flux[2]),
                          height,
                          power});
        total += power;
    }
    for (Disc& disc : _discs) disc.share /= total;
}

bool SunEnvironment::inside(const Disc& disc, const glm::dvec3& d) const
{
    const glm::dvec3 chord = d - disc.direction;
    return 0.5 * glm::dot(chord, chord) <= disc.height;
}

Incident SunEnvironment::from(const glm::dvec3& direction, bool) const
{
    Incident in{direction, glm::dvec3(0.0)};
    for (const Disc& disc : _discs)
        if (inside(disc, direction)) {
            in.radiance += disc.radiance;
            in.density += disc.share / (2.0 * pi * disc.height);
        }
    return in;
}

Incident SunEnvironment::sample(const glm::dvec2& u) const
{
    if (_discs.empty()) return {aboutPole(1.0 - 2.0 * u.x, u.y), glm::dvec3(0.0), evenly};
    double x = u.x;
    size_t i = 0;
    while (i + 1 < _discs.size() && x >= _discs[i].share) x -= _discs[i++].share;
    const double w = std::clamp(x / std::max(_discs[i].share, 1e-300), 0.0, 1.0);
    return from(frameAbout(_discs[i].direction) * aboutPoleByHeight(w * _discs[i].height, u.y));
}

}  // namespace osgEnvLight
