// SPDX-License-Identifier: MIT
#include "shadow/NearCascade.h"

#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

// What lies beyond this many median distances is left to the maps of the whole scene. A picture of streets that errs by .16 with
// those alone errs by .055, .036, .028 and .025 at 2, 3, 4 and 9, .018 of it the reference's noise.
const double farthest = 4.0;
// An eye no further from the middle of what it sees, in radii of that, is amid it.
const double amid = 1.5;
// How much larger than what the view shows: how far the view may wander. The sphere stays while it is no larger than the second.
const double reserve = 1.5;
const double tooLarge = 4.0;

osg::BoundingSphered about(const osg::Vec3d& center, const std::vector<osg::Vec3d>& points)
{
    double radius = 0.0;
    for (const osg::Vec3d& p : points) radius = std::max(radius, (p - center).length());
    return osg::BoundingSphered(center, radius);
}

std::vector<osg::Vec3d> nearOnes(const ProbedPoints& seen)
{
    if (!seen.eye) return seen.points;
    std::vector<double> distances;
    for (const osg::Vec3d& p : seen.points) distances.push_back((p - *seen.eye).length());
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    std::vector<osg::Vec3d> points;
    for (const osg::Vec3d& p : seen.points)
        if ((p - *seen.eye).length() <= farthest * *middle) points.push_back(p);
    return points;
}

osg::BoundingSphered sphereOf(const ProbedPoints& seen)
{
    const std::vector<osg::Vec3d> points = nearOnes(seen);
    osg::BoundingBoxd box;
    for (const osg::Vec3d& p : points) box.expandBy(p);
    const osg::BoundingSphered sphere = about(box.center(), points);
    if (seen.eye && (sphere.center() - *seen.eye).length() < amid * sphere.radius()) return about(*seen.eye, points);
    return sphere;
}

}  // namespace

void NearCascade::follow(const ProbedPoints& seen, double sceneRadius)
{
    if (seen.points.empty()) return;
    const osg::BoundingSphered wanted = sphereOf(seen);
    const bool within = _sphere.valid() && (wanted.center() - _sphere.center()).length() + wanted.radius() <= _sphere.radius();
    if (within && _sphere.radius() < tooLarge * wanted.radius()) return;
    // Steps of the radius and of the centre: maps drawn anew for a neighbouring place have the former's texels.
    const double radius = std::exp2(std::ceil(2.0 * std::log2(reserve * wanted.radius())) / 2.0);
    _sphere.init();
    if (!(radius > 0.0) || !(radius <= largest * sceneRadius)) return;
    _sphere = osg::BoundingSphered(wanted.center(), radius);
}

}  // namespace osgEnvLight
