// SPDX-License-Identifier: MIT
#include "indirect/PointLinks.h"

#include "base/Limits.h"
#include "indirect/StoppedRay.h"

#include <cmath>
#include <limits>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// A point lies in a hollow if something is close in so many directions. Probes do not fit into the hollow, so it does not ask
// them.
const int hollow = limits::POINT_LINKS / 4;

// Direction k of point i: Hammersley's set, moved in another way for each point.
osg::Vec3f directionOf(const SurfacePoint& point, unsigned i, unsigned k)
{
    const glsl::vec2 shift = glsl::sobolPoint(i), u = glsl::hammersley(k, limits::POINT_LINKS);
    const glsl::vec2 moved(std::fmod(u.x + shift.x, 1.0), std::fmod(u.y + shift.y, 1.0));
    const glsl::vec3 n(point.normal.x(), point.normal.y(), point.normal.z());
    const glsl::vec3 d = glsl::frameAround(n) * glsl::phongSample(1.0, moved);
    return osg::Vec3f(float(d.x), float(d.y), float(d.z));
}

// Links of points.
class Linker
{
  public:
    Linker(const TracedScene& scene, const CasterBvh& bvh, const std::vector<SurfacePoint>& points, const NearestPoint& nearest)
        : _scene(scene), _bvh(bvh), _points(points), _nearest(nearest)
    {
    }

    // What point i meets within a distance in direction k. lift: off the point's own surface.
    int link(unsigned i, unsigned k, float lift, float within) const
    {
        const osg::Vec3f from = _points[i].position + _points[i].normal * lift, to = directionOf(_points[i], i, k);
        const std::optional<CasterBvh::Hit> hit = stoppedRay(_scene, _bvh, from, to, within);
        if (!hit) return NOTHING;
        if (hit->back && _scene.surfaces[_scene.surfaceOf[hit->triangle]].closed) return INSIDE_OF_BODY;
        return int(_nearest.find(from + to * hit->distance, hit->triangle, hit->back));
    }

  private:
    const TracedScene& _scene;
    const CasterBvh& _bvh;
    const std::vector<SurfacePoint>& _points;
    const NearestPoint& _nearest;
};

}  // namespace

std::vector<int> linkPoints(const TracedScene& scene, const CasterBvh& bvh, const std::vector<SurfacePoint>& points,
                            const NearestPoint& nearest, float within, const std::atomic<bool>* stop)
{
    const Linker linker(scene, bvh, points, nearest);
    const float lift = 1e-3f * within;
    std::vector<int> links(points.size() * limits::POINT_LINKS, NOTHING);
    for (unsigned i = 0; i < points.size() && !(stop && *stop); ++i) {
        int* own = &links[size_t(i) * limits::POINT_LINKS];
        int close = 0;
        for (unsigned k = 0; k < unsigned(limits::POINT_LINKS); ++k) {
            own[k] = linker.link(i, k, lift, within);
            if (own[k] != NOTHING) ++close;
        }
        if (close < hollow) continue;
        for (unsigned k = 0; k < unsigned(limits::POINT_LINKS); ++k)
            if (own[k] == NOTHING) own[k] = linker.link(i, k, lift, std::numeric_limits<float>::max());
    }
    return links;
}

}  // namespace osgEnvLight
