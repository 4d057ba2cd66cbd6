// SPDX-License-Identifier: MIT
#include "shadow/EmitterMaps.h"

#include "base/Limits.h"
#include "gl/TargetTexture.h"

#include <osg/Math>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// A caster or a light that has moved by more than this, in shares of what casts shadows, makes maps outdated.
const double movedShare = 1e-4;
// Of the same, where maps begin that show the most.
const double leastNear = 1e-5;

}  // namespace

EmitterMaps::EmitterMaps(unsigned pointCount, unsigned mapSize) : points(pointCount), size(mapSize), _maps(pointCount)
{
    const auto columns = unsigned(std::ceil(std::sqrt(double(points))));
    const unsigned batch = std::clamp(1024u / size, 1u, 8u);
    _targets = ShadowTargets(size, columns, (points + columns - 1) / columns, batch, GL_RG16, GL_RGBA16F_ARB);
}

void EmitterMaps::setCasters(const CasterList& casters)
{
    const double slack = movedShare * _extent;
    _moved = _casters.take(casters, slack);
    _fitted = _moved && (casters.bound._min != _box._min || casters.bound._max != _box._max);
    if (_moved) {
        _box = casters.bound;
        _extent = _box.valid() ? diagonal(_box) : 0.0;
        if (_version == 0 || (_box.center() - _targets.origin).length() > 16.0 * _extent) _targets.origin = _box.center();
    }
    _still.setPlace(_targets.origin, 0.1 * _extent / size);
    _still.update(casters, _moved, slack);
}

void EmitterMaps::place(Map& map, const EmitterPoint& point) const
{
    const glsl::mat3 frame = glsl::frameAround(glsl::vec3(point.normal.x(), point.normal.y(), point.normal.z()));
    const osg::Vec3d t(frame[0].x, frame[0].y, frame[0].z), b(frame[1].x, frame[1].y, frame[1].z);
    map.position = point.position;
    map.across = t * std::cos(point.turn) + b * std::sin(point.turn);
    map.up = b * std::cos(point.turn) - t * std::sin(point.turn);
    map.along = point.normal;
    map.widest = point.tangent;
}

// The window about all that casts shadows, within the widest one: a lamp far off has as fine a map as a near one.
void EmitterMaps::fit(Map& map, double nearestOccluder) const
{
    const double widest = map.widest;
    const double least = std::clamp(nearestOccluder, leastNear * _extent, glsl::EMITTER_MAP_NEAR * _extent);
    double nearest = 1e300, farthest = 2.0 * least;
    osg::BoundingBoxd seen;  // x, y at distance 1
    for (unsigned i = 0; i < 8 && _box.valid(); ++i) {
        const osg::Vec3d corner = _box.corner(i) - map.position;
        const double z = corner * map.along;
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
        if (z > least) seen.expandBy(osg::Vec3d(corner * map.across / z, corner * map.up / z, 0.0));
    }
    const bool isInside = !(nearest > least);
    osg::Vec2d low(-widest, -widest), high(widest, widest);
    for (int i = 0; i < 2 && !isInside; ++i) {
        low[i] = std::clamp(seen._min[i], -widest, widest);
        high[i] = std::clamp(seen._max[i], -widest, widest);
    }
    map.window = (low + high) * 0.5;
    map.tangent = std::max(std::max(high[0] - low[0], high[1] - low[1]) * 0.5 * (1.0 + 4.0 / size), 1e-6);
    const double margin = 0.01 * std::max(farthest - nearest, 0.0);
    map.nearest = isInside ? least : std::max(nearest - margin, 0.5 * nearest);
    map.octaves = std::log2((farthest + margin) / map.nearest);
}

// Depths are 1 - nearest / distance.
osg::Matrixd EmitterMaps::projection(const Map& map) const
{
    const osg::Vec3d position = map.position - _targets.origin;
    const osg::Vec3d axes[] = {(map.across - map.along * map.window[0]) / map.tangent,
                               (map.up - map.along * map.window[1]) / map.tangent, map.along, map.along};
    osg::Matrixd m;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) m(row, column) = axes[column].ptr()[row];
        m(3, column) = -(position * axes[column]) - (column == 2 ? 2.0 * map.nearest : 0.0);
    }
    return m;
}

double EmitterMaps::priority(const Map& map, const EmitterPoint& point) const
{
    const double power = point.power[0] + point.power[1] + point.power[2];
    if (!(power > 0.0)) return 0.0;
    if (!map.drawn) return 1e6 * power;
    return map.outdated ? power * (1.0 + map.age) : 0.0;
}

std::vector<ShadowRefresh> EmitterMaps::update(const std::vector<EmitterPoint>& list, unsigned budget)
{
    if (_lost.exchange(false))
        for (Map& map : _maps) map.drawn = false;
    const bool changed = list != _list;
    _list = list;
    std::vector<std::pair<double, unsigned>> wanted;
    for (unsigned i = 0; i < points; ++i) {
        Map& map = _maps[i];
        const bool elsewhere = (list[i].position - map.position).length() > movedShare * _extent ||
                               (list[i].normal - map.along).length() > movedShare || list[i].tangent != map.widest;
        map.outdated = map.outdated || elsewhere;
        if (list[i].lightNumber != map.lightNumber) map.drawn = false;
        map.lightNumber = list[i].lightNumber;
        if (_moved) map.noteChange(_casters.changed(), _targets.origin, size);
        if (_fitted) map.outdated = true;
        map.age = map.outdated ? map.age + 1 : 0;
        const double p = priority(map, list[i]);
        if (p > 0.0) wanted.emplace_back(-p, i);
    }
    const size_t count = std::min<size_t>(budget, wanted.size());
    _waiting = unsigned(wanted.size() - count);
    std::partial_sort(wanted.begin(), wanted.begin() + std::ptrdiff_t(count), wanted.end());
    std::vector<ShadowRefresh> refreshes;
    for (size_t k = 0; k < count; ++k) {
        Map& map = _maps[wanted[k].second];
        place(map, list[wanted[k].second]);
        fit(map, list[wanted[k].second].nearest);
        const MapRegion region = map.draw(projection(map), _targets.origin, size);
        refreshes.push_back({wanted[k].second, map.projection, float(2.0 * map.tangent / size), float(map.octaves), region});
    }
    if (changed || !refreshes.empty()) ++_version;
    return refreshes;
}

// By which sums of what the points send fit half floats: 256 for what gets most. In a scene about the lights that is the radiance
// of the brightest; far from them, what arrives.
double EmitterMaps::scale() const
{
    double most = 0.0;
    for (const EmitterPoint& point : _list) {
        double square = 0.0;  // of the distance to what casts shadows
        for (int i = 0; i < 3 && _box.valid(); ++i) {
            const double outside = std::max({_box._min[i] - point.position[i], point.position[i] - _box._max[i], 0.0});
            square += outside * outside;
        }
        const double power = std::max({point.power[0], point.power[1], point.power[2]});
        most = std::max(most, power / (osg::PI * square + point.area));
    }
    return most > 0.0 ? 256.0 / most : 0.0;
}

osg::ref_ptr<osg::Image> EmitterMaps::pointImage() const
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(points), limits::EMITTER_POINT_ROWS, 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    const double sumScale = scale();
    for (unsigned i = 0; i < points; ++i) {
        const EmitterPoint& point = _list[i];
        const Map& map = _maps[i];
        const osg::Vec3d drawnFrom = map.position - _targets.origin;
        writeTexel(*image, i, 0, point.position - _targets.origin, point.area);
        writeTexel(*image, i, 1, point.normal, map.nearest);
        writeTexel(*image, i, 2, point.power, map.octaves);
        writeTexel(*image, i, 3, map.across, -(drawnFrom * map.across));
        writeTexel(*image, i, 4, map.up, -(drawnFrom * map.up));
        writeTexel(*image, i, 5, map.along, -(drawnFrom * map.along));
        writeTexel(*image, i, 7, point.even, point.isRound ? -point.tangent : point.tangent);
        writeTexel(*image, i, 6, osg::Vec3d(map.window[0], map.window[1], sumScale), map.drawn ? map.tangent : 0.0);
    }
    return image;
}

void EmitterMaps::resizeGLObjectBuffers(unsigned maximum)
{
    _targets.resizeGLObjectBuffers(maximum);
    _still.resizeGLObjectBuffers(maximum);
}

void EmitterMaps::releaseGLObjects(osg::State* state) const
{
    _targets.releaseGLObjects(state);
    _still.releaseGLObjects(state);
    _lost = true;
}

size_t EmitterMaps::bytes() const
{
    const size_t map = size_t(size) * size;
    const size_t rows = (points + _targets.columns - 1) / _targets.columns;
    return 4 * map * _targets.columns * rows + (8 + 4 + 4) * map * _targets.batch + _still.bytes();
}

}  // namespace osgEnvLight
