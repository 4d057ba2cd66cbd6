// SPDX-License-Identifier: MIT
#include "shadow/ShadowAtlas.h"

#include "base/Limits.h"
#include "base/R2Points.h"
#include "gl/TargetTexture.h"
#include "lights/SolidAngles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const unsigned groups = limits::LIGHT_GROUPS;

// A map whose light has moved by more than this [chord] is drawn again; if further than the second, it is another light's.
const double movedLight = 1e-4;
const double anotherLight = 0.2;

bool sameLights(const LightList& a, const LightList& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const DirectionalLight& x, const DirectionalLight& y) {
        return x.direction == y.direction && x.flux == y.flux;
    });
}

// An order in which each beginning lies spread over the sphere, and every so many lights hold one of each group: the one of the
// group that is farthest from those before it; those without flux last.
std::vector<unsigned> spreadRanks(const LightList& list)
{
    std::vector<unsigned> rank(list.size(), unsigned(list.size()));
    std::vector<double> nearness(list.size(), -2.0);  // largest cosine to those before it
    for (unsigned next = 0; next < list.size(); ++next) {
        unsigned best = unsigned(list.size());
        const auto isBetter = [&](unsigned i) {
            const bool shines = sumOf(list[i].flux) > 0.0, bestShines = sumOf(list[best].flux) > 0.0;
            return shines != bestShines ? shines : nearness[i] < nearness[best];
        };
        for (unsigned i = next % groups; i < list.size(); i += groups)
            if (rank[i] == list.size() && (best == list.size() || isBetter(i))) best = i;
        rank[best] = next;
        for (unsigned i = 0; i < list.size(); ++i) nearness[i] = std::max(nearness[i], list[i].direction * list[best].direction);
    }
    return rank;
}

void writeRow(osg::Image& image, unsigned light, unsigned row, const osg::Vec3d& v, double w)
{
    writeTexel(image, light / groups, 4 * (light % groups) + row, v, w);
}

}  // namespace

ShadowAtlas::ShadowAtlas(unsigned lightCount, unsigned mapSize) : lights(lightCount), size(mapSize), _maps(lightCount)
{
    const auto columns = unsigned(std::ceil(std::sqrt(double(lights))));
    const unsigned batch = std::clamp(1024u / size, 1u, 8u);
    _targets = ShadowTargets(size, columns, (lights + columns - 1) / columns, batch, GL_RG16, GL_RGBA16F_ARB);
}

// The bound stays while it fits: a caster that wanders within it moves no map.
bool ShadowAtlas::fit(const osg::BoundingBoxd& bound)
{
    if (!bound.valid() || (contains(_box, bound) && diagonal(bound) > 0.5 * diagonal(_box))) return false;
    const double margin = 0.02 * diagonal(bound);
    const osg::Vec3d more(margin, margin, margin);
    _box = osg::BoundingBoxd(bound._min - more, bound._max + more);
    if ((_box.center() - _targets.origin).length() < 16.0 * diagonal(_box) && _version > 0) return true;
    _targets.origin = _box.center();  // floats about it keep their digits
    for (Map& map : _maps) map.drawn = false;
    return true;
}

void ShadowAtlas::place(Map& map, unsigned index, const osg::Vec3d& direction) const
{
    const glsl::mat3 frame = glsl::frameAround(glsl::vec3(direction.x(), direction.y(), direction.z()));
    const osg::Vec3d t(frame[0].x, frame[0].y, frame[0].z), b(frame[1].x, frame[1].y, frame[1].z);
    // Golden angle: neighbours' texels don't fall in step.
    const double turn = 2.39996322972865332 * (index + double(lights) * _turn);
    map.across = t * std::cos(turn) + b * std::sin(turn);
    map.up = b * std::cos(turn) - t * std::sin(turn);
    map.along = direction;
    map.center = _focus.valid() ? _focus.center() : _box.center();
    map.radius = _focus.valid() ? _focus.radius() : 0.0;
    for (unsigned i = 0; i < 8 && !_focus.valid(); ++i) {
        const osg::Vec3d corner = _box.corner(i) - map.center;
        for (const osg::Vec3d& axis : {map.across, map.up, map.along}) map.radius = std::max(map.radius, std::abs(corner * axis));
    }
    map.radius *= 1.0 + 2.0 / size;  // a texel about
    const double texel = 2.0 * map.radius / size;
    if (_focus.valid())  // the next focus's texels are these
        for (const osg::Vec3d& axis : {map.across, map.up})
            map.center += axis * (std::round(map.center * axis / texel) * texel - map.center * axis);
    if (_turn == 0) return;
    const osg::Vec2d shift = r2Point(index + lights * _turn) - osg::Vec2d(0.5, 0.5);
    map.center += (map.across * shift[0] + map.up * shift[1]) * texel;
}

osg::Matrixd ShadowAtlas::projection(const Map& map) const
{
    osg::Matrixd m;
    const osg::Vec3d axes[] = {map.across / map.radius, map.up / map.radius, -map.along / map.radius};
    const osg::Vec3d center = map.center - _targets.origin;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) m(row, column) = axes[column].ptr()[row];
        m(3, column) = -(center * axes[column]);
    }
    return m;
}

double ShadowAtlas::priority(const Map& map, const osg::Vec3d& flux) const
{
    const double sum = sumOf(flux);
    if (!(sum > 0.0)) return 0.0;
    if (!map.drawn) return 1e6 * sumOf(_list) * (lights - _rank[size_t(&map - _maps.data())]);
    if (map.former) return 1e3 * sum;
    return map.outdated ? sum * (1.0 + map.age) : 0.0;
}

void ShadowAtlas::setFocus(const osg::BoundingSphered& sphere)
{
    if (sphere.center() == _focus.center() && sphere.radius() == _focus.radius()) return;
    _formerFocus = _focus.valid() ? shown() : sphere;
    _focus = sphere;
    for (Map& map : _maps) map.outdated = true;
}

osg::BoundingSphered ShadowAtlas::shown() const
{
    const double left = double(_waiting) / lights;
    return osg::BoundingSphered(_focus.center() + (_formerFocus.center() - _focus.center()) * left,
                                _focus.radius() + (_formerFocus.radius() - _focus.radius()) * left);
}

void ShadowAtlas::setCasters(const CasterList& casters)
{
    const double side = _focus.valid() ? 2.0 * _focus.radius() : diagonal(_box);
    const double texel = _box.valid() ? side / size : 0.0;
    _moved = _casters.take(casters, 0.02 * texel);
    _fitted = _moved && fit(casters.bound);
    if (!_box.valid() || _focus.valid()) return;
    _still.setPlace(_targets.origin, 0.5 * diagonal(_box) / size);
    _still.update(casters, _moved, 0.02 * texel);
}

// A light that has moved little keeps its map and has its new flux. Where one is elsewhere now, the former and its map stay until
// the new one's is drawn, as bright beside the rest as it was: the light comes over map by map. While some lights have no map
// yet, all begin anew instead.
void ShadowAtlas::setLights(const LightList& list)
{
    const double before = sumOf(_list);
    const double factor = before > 0.0 ? sumOf(list) / before : 1.0;
    const std::vector<double> angles = solidAngles(list);
    const auto hasLeft = [&](unsigned i) {
        return _maps[i].drawn && (list[i].direction - _maps[i].along).length() > anotherLight;
    };
    bool beginsAnew = false;
    for (unsigned i = 0; i < lights && !complete(); ++i) beginsAnew = beginsAnew || hasLeft(i);
    for (unsigned i = 0; i < lights; ++i) {
        Map& map = _maps[i];
        map.drawn = map.drawn && !beginsAnew;
        map.former = hasLeft(i);
        if (map.former)
            map.flux *= factor;
        else
            std::tie(map.flux, map.solidAngle) = std::tie(list[i].flux, angles[i]);
        if (!map.drawn) map.along = list[i].direction;
    }
    _list = list;
    _solidAngles = angles;
    _rank = spreadRanks(list);
}

// Of the light as it is now.
ShadowRefresh ShadowAtlas::draw(unsigned index)
{
    Map& map = _maps[index];
    place(map, index, _list[index].direction);
    const MapRegion region = map.draw(projection(map), _targets.origin, size);
    map.former = false;
    map.flux = _list[index].flux;
    map.solidAngle = _solidAngles[index];
    return {index, map.projection, 0.0f, 0.0f, region};
}

// In maps: by its triangles, but that it is drawn at all takes some time.
double ShadowAtlas::cost(const ShadowRefresh& refresh) const
{
    const double least = 0.25;
    if (refresh.region.isEmpty()) return 0.0;
    if (_focus.valid() || refresh.region.isWhole()) return 1.0;
    return std::max(_still.shareShown(refresh.region.projection(refresh.projection, size)), least);
}

std::vector<ShadowRefresh> ShadowAtlas::update(const LightList& list, unsigned budget)
{
    if (_lost.exchange(false))
        for (Map& map : _maps) map.drawn = false;
    const bool changed = !sameLights(list, _list);
    if (changed) setLights(list);
    std::vector<std::pair<double, unsigned>> wanted;
    for (unsigned i = 0; i < lights; ++i) {
        Map& map = _maps[i];
        const double step = (list[i].direction - map.along).length();
        map.outdated = map.outdated || step > movedLight;
        if (_moved) map.noteChange(_casters.changed(), _targets.origin, size);
        if (_fitted) map.outdated = true;
        map.age = map.outdated ? map.age + 1 : 0;
        const double p = priority(map, list[i].flux);
        if (p > 0.0) wanted.emplace_back(-p, i);
    }
    std::sort(wanted.begin(), wanted.end());
    std::vector<ShadowRefresh> refreshes;
    double spent = 0.0;
    while (_box.valid() && refreshes.size() < wanted.size() && spent < budget) {
        refreshes.push_back(draw(wanted[refreshes.size()].second));
        spent += cost(refreshes.back());
    }
    _spent = unsigned(std::ceil(spent));
    _waiting = unsigned(wanted.size() - refreshes.size());
    if (changed || !refreshes.empty()) ++_version;
    return refreshes;
}

void ShadowAtlas::writePlace(osg::Image& image, unsigned index, unsigned firstRow, const osg::Vec3d& origin) const
{
    const Map& map = _maps[index];
    const osg::Vec3d along = map.along;
    const osg::Vec3d center = map.center - origin;
    const double height = map.drawn ? 0.5 / map.radius : 1.0;
    const double texels = height * size;
    writeRow(image, index, firstRow, map.across * texels, 0.5 * size - center * map.across * texels);
    writeRow(image, index, firstRow + 1, map.up * texels, 0.5 * size - center * map.up * texels);
    writeRow(image, index, firstRow + 2, along * height, 0.5 - center * along * height);
}

// While lights move, maps of the one atlas may be of where a light was and those of the other not.
bool ShadowAtlas::showsAs(const ShadowAtlas& other, unsigned index) const
{
    const Map &map = _maps[index], &like = other._maps[index];
    return map.drawn && like.drawn && (map.along - like.along).length() <= movedLight;
}

bool ShadowAtlas::hasMap() const
{
    return std::any_of(_maps.begin(), _maps.end(), [](const Map& map) { return map.drawn; });
}

// By light, itself where it has a map or no light has one, else the nearest that has.
std::vector<unsigned> ShadowAtlas::servingLights() const
{
    std::vector<unsigned> serving(lights);
    std::iota(serving.begin(), serving.end(), 0u);
    if (!hasMap()) return serving;
    for (unsigned i = 0; i < lights; ++i) {
        if (_maps[i].drawn) continue;
        double largest = -2.0;
        for (unsigned k = 0; k < lights; ++k) {
            const double cosine = _maps[i].along * _maps[k].along;
            if (_maps[k].drawn && cosine > largest) std::tie(largest, serving[i]) = std::tuple(cosine, k);
        }
    }
    return serving;
}

osg::ref_ptr<osg::Image> ShadowAtlas::lightImage(double scale, const ShadowAtlas* finer) const
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(lights / groups), int(4 * groups) * (finer ? 2 : 1), 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    std::vector<osg::Vec4d> lit(lights);  // flux and solid angle
    const std::vector<unsigned> serving = servingLights();
    for (unsigned i = 0; i < lights; ++i) lit[serving[i]] += osg::Vec4d(_maps[i].flux, _maps[i].solidAngle);
    for (unsigned i = 0; i < lights; ++i) {
        writePlace(*image, i, 0, _targets.origin);
        const double angle = std::max(lit[i][3], 1e-6);
        writeRow(*image, i, 3, osg::Vec3d(lit[i][0], lit[i][1], lit[i][2]) * scale, _maps[i].drawn ? angle : -angle);
        if (!finer) continue;
        finer->writePlace(*image, i, 4 * groups, _targets.origin);
        writeRow(*image, i, 67, osg::Vec3d(), finer->showsAs(*this, i) ? 1.0 : -1.0);
    }
    return image;
}

osg::ref_ptr<osg::Image> ShadowAtlas::nearestImage() const
{
    const int side = 32;  // 6 degrees: half of what 256 lights lie apart
    std::vector<osg::Vec3f> directions(lights);
    for (unsigned i = 0; i < lights; ++i) directions[i] = osg::Vec3f(_maps[i].along);
    const bool someHaveMaps = hasMap();
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2 * side, side, 1, GL_RGBA_INTEGER_EXT, GL_UNSIGNED_INT);
    image->setInternalTextureFormat(GL_RGBA32UI_EXT);
    std::vector<float> cosine(lights);
    std::vector<unsigned> order(lights);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glsl::vec3 d = glsl::directionFromOctahedral((glsl::vec2(x, y) + 0.5) / double(side));
            const osg::Vec3f direction(float(d.x), float(d.y), float(d.z));
            for (unsigned i = 0; i < lights; ++i) cosine[i] = _maps[i].drawn || !someHaveMaps ? directions[i] * direction : -2.0f;
            std::iota(order.begin(), order.end(), 0u);
            std::partial_sort(order.begin(), order.begin() + limits::NEAREST_LIGHTS, order.end(),
                              [&](unsigned a, unsigned b) { return cosine[a] > cosine[b]; });
            uint32_t* numbers = reinterpret_cast<uint32_t*>(image->data(unsigned(2 * x), unsigned(y)));
            std::fill_n(numbers, limits::NEAREST_LIGHTS / 2, 0u);
            for (int k = 0; k < limits::NEAREST_LIGHTS; ++k) numbers[k / 2] |= order[size_t(k)] << (16 * (k % 2));
        }
    return image;
}

double ShadowAtlas::texel() const
{
    double radius = 0.0;
    for (const Map& map : _maps) radius = std::max(radius, map.radius);
    return 2.0 * radius / size;
}

bool ShadowAtlas::complete() const
{
    for (unsigned i = 0; i < lights; ++i)
        if (!_maps[i].drawn && (_list.empty() || sumOf(_list[i].flux) > 0.0)) return false;
    return true;
}

void ShadowAtlas::resizeGLObjectBuffers(unsigned maximum)
{
    _targets.resizeGLObjectBuffers(maximum);
    _still.resizeGLObjectBuffers(maximum);
}

void ShadowAtlas::releaseGLObjects(osg::State* state) const
{
    _targets.releaseGLObjects(state);
    _still.releaseGLObjects(state);
    _lost = true;
}

size_t ShadowAtlas::bytes() const
{
    const size_t map = size_t(size) * size;
    const size_t rows = (lights + _targets.columns - 1) / _targets.columns;
    return 4 * map * _targets.columns * rows + (8 + 4 + 4) * map * _targets.batch + _still.bytes();
}

}  // namespace osgEnvLight
