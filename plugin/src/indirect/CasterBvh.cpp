// SPDX-License-Identifier: MIT
#include "indirect/CasterBvh.h"

#include "base/Limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgEnvLight
{

namespace
{

constexpr int bins = 16;
constexpr int deepest = limits::BVH_DEPTH;  // halves from 32 on, so that 2^32 triangles fit
constexpr float nowhere = std::numeric_limits<float>::max();

float halfArea(const osg::BoundingBoxf& box)
{
    if (!box.valid()) return 0.0f;
    const osg::Vec3f e = box._max - box._min;
    return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
}

// Where a ray enters the box, or nowhere.
float entry(const osg::BoundingBoxf& box, const osg::Vec3f& origin, const osg::Vec3f& inverse, float limit)
{
    float near = 0.0f, far = limit;
    for (int k = 0; k < 3; ++k) {
        const float a = (box._min[k] - origin[k]) * inverse[k];
        const float b = (box._max[k] - origin[k]) * inverse[k];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near <= far ? near : nowhere;
}

float inverseOf(float x)
{
    const float least = 1e-20f;  // whose inverse times a box's corner is still finite
    return 1.0f / (std::abs(x) < least ? std::copysign(least, x) : x);
}

}  // namespace

struct CasterBvh::Range {
    uint32_t node, from, to;
    int depth;
    uint32_t size() const { return to - from; }
};

// Triangles whose centres' doubles lie below the place along the axis go to the left.
struct CasterBvh::Split {
    int axis = -1;  // none is worth it
    float place = 0.0f;
};

CasterBvh::CasterBvh(const TracedScene& scene, const std::atomic<bool>* stop)
{
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const osg::Vec3f &a = scene.corner(i, 0), &b = scene.corner(i, 1), &c = scene.corner(i, 2);
        const float size = scene.normal(i).length2();
        if (!(size > 0.0f) || !std::isfinite(size)) continue;
        osg::BoundingBoxf box;
        for (const osg::Vec3f& p : {a, b, c}) box.expandBy(p);
        _triangles.push_back({a, b - a, c - a, uint32_t(i)});
        _boxes.push_back(box);
    }
    if (_triangles.empty()) return;
    _nodes.emplace_back();
    std::vector<Range> open = {{0, 0, uint32_t(_triangles.size()), 0}};
    while (!open.empty()) {
        if (stop && *stop) {
            _nodes.clear();
            return;
        }
        const Range range = open.back();
        open.pop_back();
        for (uint32_t i = range.from; i < range.to; ++i) _nodes[range.node].box.expandBy(_boxes[i]);
        const uint32_t middle = range.size() > leafSize ? partition(range) : range.from;
        if (middle == range.from) {
            _nodes[range.node].first = range.from;
            _nodes[range.node].count = range.size();
            continue;
        }
        const auto children = uint32_t(_nodes.size());
        _nodes.resize(_nodes.size() + 2);
        _nodes[range.node].first = children;
        open.push_back({children, range.from, middle, range.depth + 1});
        open.push_back({children + 1, middle, range.to, range.depth + 1});
    }
    _boxes = {};
}

CasterBvh::Split CasterBvh::bestSplit(const Range& range) const
{
    osg::BoundingBoxf centers;  // doubled
    for (uint32_t i = range.from; i < range.to; ++i) centers.expandBy(_boxes[i]._min + _boxes[i]._max);
    const osg::Vec3f extent = centers._max - centers._min;
    const int axis = extent.x() >= extent.y() ? (extent.x() >= extent.z() ? 0 : 2) : (extent.y() >= extent.z() ? 1 : 2);
    Split split;
    if (!(extent[axis] > 0.0f)) return split;
    osg::BoundingBoxf boxes[bins];
    uint32_t counts[bins] = {};
    const float scale = float(bins) * 0.9999f / extent[axis];
    for (uint32_t i = range.from; i < range.to; ++i) {
        const float center = _boxes[i]._min[axis] + _boxes[i]._max[axis];
        const int bin = std::clamp(int((center - centers._min[axis]) * scale), 0, bins - 1);
        boxes[bin].expandBy(_boxes[i]);
        ++counts[bin];
    }
    float rightWork[bins] = {};
    osg::BoundingBoxf right;
    uint32_t rightCount = 0;
    for (int bin = bins - 1; bin > 0; --bin) {
        right.expandBy(boxes[bin]);
        rightCount += counts[bin];
        rightWork[bin] = halfArea(right) * float(rightCount);
    }
    osg::BoundingBoxf left;
    uint32_t leftCount = 0;
    float least = nowhere;
    for (int bin = 1; bin < bins; ++bin) {
        left.expandBy(boxes[bin - 1]);
        leftCount += counts[bin - 1];
        const float work = halfArea(left) * float(leftCount) + rightWork[bin];
        if (leftCount == 0 || leftCount == range.size() || work >= least) continue;
        least = work;
        split = {axis, centers._min[axis] + float(bin) / scale};
    }
    return split;
}

// Sorts a range into two; the start of the second.
uint32_t CasterBvh::partition(const Range& range)
{
    const Split split = range.depth < deepest / 2 ? bestSplit(range) : Split();
    uint32_t left = range.from;
    for (uint32_t i = range.from; split.axis >= 0 && i < range.to; ++i) {
        if (_boxes[i]._min[split.axis] + _boxes[i]._max[split.axis] >= split.place) continue;
        std::swap(_boxes[i], _boxes[left]);
        std::swap(_triangles[i], _triangles[left++]);
    }
    return left > range.from && left < range.to ? left : range.from + range.size() / 2;
}

// Moeller and Trumbore 1997. No ray passes between two triangles that share an edge: each is a little larger than it is.
void CasterBvh::meet(const Node& leaf, const osg::Vec3f& origin, const osg::Vec3f& direction, Hit& hit) const
{
    const float margin = 1e-5f;  // of an edge, beyond what single precision loses
    for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const Triangle& t = _triangles[i];
        const osg::Vec3f p = direction ^ t.otherEdge;
        const float determinant = t.edge * p;
        if (determinant == 0.0f) continue;
        const osg::Vec3f to = origin - t.corner;
        const float u = to * p / determinant;
        if (!(u >= -margin && u <= 1.0f + margin)) continue;
        const osg::Vec3f q = to ^ t.edge;
        const float v = direction * q / determinant;
        if (!(v >= -margin && u + v <= 1.0f + margin)) continue;
        const float distance = t.otherEdge * q / determinant;
        if (distance > 0.0f && distance < hit.distance) hit = {distance, t.number, determinant < 0.0f};
    }
}

std::optional<CasterBvh::Hit> CasterBvh::nearest(const osg::Vec3f& origin, const osg::Vec3f& direction, float within) const
{
    Hit hit{within, 0, false};
    const osg::Vec3f inverse(inverseOf(direction.x()), inverseOf(direction.y()), inverseOf(direction.z()));
    if (_nodes.empty() || entry(_nodes[0].box, origin, inverse, within) == nowhere) return std::nullopt;
    uint32_t waiting[deepest];
    int count = 0;
    uint32_t current = 0;
    for (;;) {
        const Node& node = _nodes[current];
        if (node.count > 0) {
            meet(node, origin, direction, hit);
        } else {
            uint32_t first = node.first, second = node.first + 1;
            float a = entry(_nodes[first].box, origin, inverse, hit.distance);
            float b = entry(_nodes[second].box, origin, inverse, hit.distance);
            if (b < a) {
                std::swap(a, b);
                std::swap(first, second);
            }
            if (b != nowhere) waiting[count++] = second;
            if (a != nowhere) {
                current = first;
                continue;
            }
        }
        if (count == 0) break;
        current = waiting[--count];
    }
    if (hit.distance == within) return std::nullopt;
    return hit;
}

}  // namespace osgEnvLight
