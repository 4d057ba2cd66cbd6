// SPDX-License-Identifier: MIT
#include "indirect/SurfacePoints.h"

#include "base/R2Points.h"

#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>

namespace osgEnvLight
{

namespace
{

const double densest = 0.25;  // of the focus' radius: where points are half as dense as in its centre

using Corners = std::array<osg::Vec3f, 3>;

// A side of a triangle, or of a part of one, that light may reach.
struct Side {
    uint64_t order;
    uint32_t triangle;
    bool back;
    double weight;  // its area, times the density of points
    Corners corners;
};

// Bits of three coordinates in [0,1] in turn, 10 of each.
uint64_t mortonCode(const osg::Vec3f& p)
{
    uint64_t code = 0;
    for (int bit = 9; bit >= 0; --bit)
        for (int k = 0; k < 3; ++k) code = code << 1 | (unsigned(std::clamp(p[k], 0.0f, 1.0f) * 1023.0f) >> bit & 1u);
    return code;
}

unsigned classOf(const osg::Vec3f& normal)
{
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    return unsigned(2 * axis + (normal[axis] > 0.0f));
}

osg::Vec3f middleOf(const Corners& t)
{
    return (t[0] + t[1] + t[2]) / 3.0f;
}

// Halves it along its longest edge until the density of points differs little within each part.
void split(const Corners& t, double area, const TransportFocus& focus, const std::function<void(const Corners&, double)>& visit,
           int depth = 0)
{
    const int deepest = 20;
    size_t longest = 0;
    const auto edge = [&](size_t k) { return double((t[(k + 1) % 3] - t[k]).length()); };
    for (size_t k = 1; k < 3; ++k)
        if (edge(k) > edge(longest)) longest = k;
    const double distance = (osg::Vec3d(middleOf(t)) - focus.center).length();
    if (!(focus.radius > 0.0) || depth == deepest || edge(longest) < 0.5 * std::max(distance, densest * focus.radius)) {
        visit(t, area * focus.density(distance));
        return;
    }
    const osg::Vec3f middle = (t[longest] + t[(longest + 1) % 3]) * 0.5f;
    for (const size_t k : {longest, (longest + 1) % 3}) {
        Corners half = t;
        half[k] = middle;
        split(half, 0.5 * area, focus, visit, depth + 1);
    }
}

std::vector<Side> sidesOf(const TracedScene& scene, const TransportFocus& focus)
{
    osg::BoundingBoxf box;
    for (const osg::Vec3f& p : scene.positions) box.expandBy(p);
    std::vector<Side> sides;
    for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const osg::Vec3f normal = scene.normal(i);
        const double area = scene.area(i);
        if (!(area > 0.0) || !std::isfinite(area)) continue;
        const auto add = [&](const Corners& corners, double weight) {
            osg::Vec3f place = middleOf(corners) - box._min;
            for (int k = 0; k < 3; ++k) place[k] /= std::max(box._max[k] - box._min[k], 1e-30f);
            const uint64_t code = mortonCode(place);
            sides.push_back({uint64_t(classOf(normal)) << 32 | code, i, false, weight, corners});
            if (!scene.surfaces[scene.surfaceOf[i]].closed)
                sides.push_back({uint64_t(classOf(-normal)) << 32 | code, i, true, weight, corners});
        };
        split({scene.corner(i, 0), scene.corner(i, 1), scene.corner(i, 2)}, area, focus, add);
    }
    std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.order, a.triangle, a.back) < std::tie(b.order, b.triangle, b.back);
    });
    return sides;
}

// The index-th of points spread over a triangle; the first is its middle.
osg::Vec3f pointOf(const Corners& triangle, unsigned index)
{
    const auto& [a, b, c] = triangle;
    if (index == 0) return middleOf(triangle);
    const osg::Vec2d u = r2Point(index);
    const double root = std::sqrt(u[0]);
    return osg::Vec3f(a * float(1.0 - root) + b * float(root * (1.0 - u[1])) + c * float(root * u[1]));
}

}  // namespace

double TransportFocus::density(double distance) const
{
    if (!(radius > 0.0)) return 1.0;
    const double d = distance / (densest * radius);
    return 1.0 / (1.0 + d * d);
}

std::vector<SurfacePoint> placeSurfacePoints(const TracedScene& scene, unsigned count, const TransportFocus& focus)
{
    std::vector<SurfacePoint> points;
    const std::vector<Side> sides = sidesOf(scene, focus);
    const double all = std::accumulate(sides.begin(), sides.end(), 0.0, [](double sum, const Side& s) { return sum + s.weight; });
    double before = 0.0;
    for (const Side& side : sides) {
        before += side.weight;
        const bool last = &side == &sides.back();
        for (unsigned i = 0; points.size() < count && (last || (double(points.size()) + 0.5) * all < before * count); ++i) {
            osg::Vec3f normal = scene.normal(side.triangle);
            normal.normalize();
            points.push_back({pointOf(side.corners, i), side.back ? -normal : normal, scene.surfaceOf[side.triangle]});
        }
    }
    return points;
}

std::vector<SurfacePart> placeSurfaceParts(const TracedScene& scene, const std::vector<SurfacePoint>& points,
                                           const NearestPoint& nearest, unsigned parts, const TransportFocus& focus)
{
    std::vector<std::vector<SurfacePart>> about(points.size());
    if (!points.empty())
        for (const SurfacePoint& p : placeSurfacePoints(scene, unsigned(points.size()) * parts, focus))
            about[nearest.find(p.position, p.normal, p.surface)].push_back({p.position, p.normal});
    std::vector<SurfacePart> result;
    for (size_t i = 0; i < points.size(); ++i) {
        // None is nearest to a point that lies on top of another.
        if (about[i].empty()) about[i].push_back({points[i].position, points[i].normal});
        for (size_t k = 0; k < parts; ++k) result.push_back(about[i][k * about[i].size() / parts]);
    }
    return result;
}

NearestPoint::NearestPoint(const std::vector<SurfacePoint>& points, const TracedScene& scene, const CasterBvh& bvh,
                           const TransportFocus& focus)
    : _points(points), _scene(scene), _bvh(bvh)
{
    osg::BoundingBoxf box;
    for (const SurfacePoint& p : points) box.expandBy(p.position);
    _low = box._min;
    const osg::Vec3f extent = box._max - box._min;
    double area = 0.0;
    for (size_t i = 0; i < scene.triangles.size(); ++i)
        if (const double a = scene.area(i); std::isfinite(a)) area += a;
    _spacing = float(std::sqrt(area / double(std::max(points.size(), size_t(1)))));
    _penalty = focus.radius > 0.0 ? float(0.04 * focus.radius * focus.radius) : 0.01f * extent.length2();
    _width = std::max({extent.x(), extent.y(), extent.z(), 1e-30f}) / 24.0f;
    const size_t mostCells = 16 * points.size();  // points lie on surfaces, and may crowd about a focus: most cells have none
    size_t cellCount = 0;
    for (float width = _width;; width *= 0.5f) {
        size_t count = 1;
        std::array<int, 3> along{};
        for (int k = 0; k < 3; ++k) {
            along[size_t(k)] = int(extent[k] / width) + 1;
            count *= size_t(along[size_t(k)]);
        }
        if (cellCount > 0 && (count > mostCells || count == cellCount)) break;
        std::tie(_width, _cells, cellCount) = std::make_tuple(width, along, count);
    }
    _starts.resize(cellCount + 1);
    std::vector<unsigned> cells;
    for (const SurfacePoint& p : points) {
        cells.push_back(cell(cellAlong(0, p.position.x()), cellAlong(1, p.position.y()), cellAlong(2, p.position.z())));
        ++_starts[cells.back() + 1];
    }
    std::partial_sum(_starts.begin(), _starts.end(), _starts.begin());
    _order.resize(points.size());
    std::vector<unsigned> next(_starts.begin(), _starts.end() - 1);
    for (unsigned i = 0; i < points.size(); ++i) _order[next[cells[i]]++] = i;
}

int NearestPoint::cellAlong(int axis, float position) const
{
    return int(std::clamp((position - _low[axis]) / _width, 0.0f, float(_cells[size_t(axis)] - 1)));
}

unsigned NearestPoint::find(const osg::Vec3f& position, const osg::Vec3f& normal, unsigned surface) const
{
    const unsigned nearest = find(position, normal, surface, nullptr);
    if (nearest == none) return 0;  // too far away for a number
    if (sees(position, normal, _points[nearest])) return nearest;
    const unsigned seen = find(position, normal, surface, [&](const SurfacePoint& p) { return sees(position, normal, p); });
    return seen == none ? nearest : seen;
}

unsigned NearestPoint::find(const osg::Vec3f& position, unsigned triangle, bool back) const
{
    osg::Vec3f normal = _scene.normal(triangle);
    normal.normalize();
    return find(position, back ? -normal : normal, _scene.surfaceOf[triangle]);
}

// From above the one to above the other, as far as on a surface that bends a little between them.
bool NearestPoint::sees(const osg::Vec3f& position, const osg::Vec3f& normal, const SurfacePoint& point) const
{
    const float lift = 0.25f * (point.position - position).length();
    if (!(lift > 0.0f)) return true;
    const osg::Vec3f from = position + normal * lift, to = point.position + point.normal * lift;
    const std::optional<CasterBvh::Hit> hit = _bvh.nearest(from, to - from, 1.0f);
    return !hit || _scene.surfaces[_scene.surfaceOf[hit->triangle]].opacity < 1.0f;
}

// Of those that are accepted; nullptr accepts all.
unsigned NearestPoint::find(const osg::Vec3f& position, const osg::Vec3f& normal, unsigned surface, const Accept& accept) const
{
    const int x = cellAlong(0, position.x()), y = cellAlong(1, position.y()), z = cellAlong(2, position.z());
    float least = std::numeric_limits<float>::max();
    unsigned found = none;
    for (int ring = 0; ring < std::max({_cells[0], _cells[1], _cells[2]}); ++ring) {
        for (int k = std::max(z - ring, 0); k <= std::min(z + ring, _cells[2] - 1); ++k)
            for (int j = std::max(y - ring, 0); j <= std::min(y + ring, _cells[1] - 1); ++j)
                for (int i = std::max(x - ring, 0); i <= std::min(x + ring, _cells[0] - 1); ++i) {
                    if (std::max({std::abs(i - x), std::abs(j - y), std::abs(k - z)}) < ring) continue;
                    for (unsigned n = _starts[cell(i, j, k)]; n < _starts[cell(i, j, k) + 1]; ++n) {
                        const SurfacePoint& p = _points[_order[n]];
                        float far = (p.position - position).length2();
                        if (p.normal * normal < 0.5f) far = 16.0f * far + _penalty;
                        if (p.surface != surface) far = 16.0f * far + _penalty;
                        if (far < least && (!accept || accept(p))) std::tie(least, found) = std::make_tuple(far, _order[n]);
                    }
                }
        if (least <= float(ring) * _width * float(ring) * _width) break;  // what is left lies farther away
    }
    return found;
}

}  // namespace osgEnvLight
