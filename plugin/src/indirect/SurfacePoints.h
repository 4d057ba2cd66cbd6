/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/CasterBvh.h"

#include <functional>

namespace osgEnvLight
{

/** A point that stands for the surface about it. */
struct SurfacePoint {
    osg::Vec3f position;
    osg::Vec3f normal;
    unsigned surface;  // its number in the scene
};

/** What a view shows of a scene that is far larger. */
struct TransportFocus {
    osg::Vec3d center;
    double radius = 0.0;  // 0: all of the scene

    /** That of points, at that distance from the centre, of those per area there. */
    double density(double distance) const;
    bool operator==(const TransportFocus& o) const { return center == o.center && radius == o.radius; }
};

/** Points spread evenly over the area of all surfaces, or more densely about the focus: systematic along a Morton curve within
 * six classes of normals, so that those that follow each other are neighbours [indirect.md 4]. Surfaces that are not closed have
 * points on both sides. None where there is no area.*/
OSGENVLIGHT_EXPORT std::vector<SurfacePoint> placeSurfacePoints(const TracedScene& scene, unsigned count,
                                                                const TransportFocus& focus = {});

/** Finds the point that stands for a place on a surface. */
class OSGENVLIGHT_EXPORT NearestPoint
{
  public:
    /** All but the focus outlive this.
     * @param focus  of the points */
    NearestPoint(const std::vector<SurfacePoint>& points, const TracedScene& scene, const CasterBvh& bvh,
                 const TransportFocus& focus = {});

    /** The number of the nearest point that no wall hides, or of the nearest if all are hidden: light must not pass from room to
     * room along their floor. One of another surface, or whose normal is over 60 degrees away, counts as four times as far and
     * more: a lamp in front of a wall is not the wall.
     * @param normal  of unit length */
    unsigned find(const osg::Vec3f& position, const osg::Vec3f& normal, unsigned surface) const;

    /** The same where a ray meets a triangle. back: from behind. */
    unsigned find(const osg::Vec3f& position, unsigned triangle, bool back) const;

    /** Side of the square that a point stands for, as a mean. */
    float spacing() const { return _spacing; }

  private:
    using Accept = std::function<bool(const SurfacePoint&)>;
    static constexpr unsigned none = ~0u;
    unsigned find(const osg::Vec3f& position, const osg::Vec3f& normal, unsigned surface, const Accept& accept) const;
    bool sees(const osg::Vec3f& position, const osg::Vec3f& normal, const SurfacePoint& point) const;
    int cellAlong(int axis, float position) const;
    unsigned cell(int x, int y, int z) const { return unsigned((z * _cells[1] + y) * _cells[0] + x); }

    const std::vector<SurfacePoint>& _points;
    const TracedScene& _scene;
    const CasterBvh& _bvh;
    osg::Vec3f _low;
    float _width = 0.0f;          // of a cell
    std::array<int, 3> _cells{};  // along each axis
    float _penalty = 0.0f;
    float _spacing = 0.0f;
    std::vector<unsigned> _starts;  // of each cell, in _order
    std::vector<unsigned> _order;   // numbers of points, by cells
};

/** A place on what a point stands for. */
struct SurfacePart {
    osg::Vec3f position;
    osg::Vec3f normal;
};

/** So many places for each point, one point's after the other's, spread as the points are over the surface that is nearest to
 * it: what lights only a part of that, as a narrow spot does, lights a share of them [indirect2.md 5, sub-points].*/
OSGENVLIGHT_EXPORT std::vector<SurfacePart> placeSurfaceParts(const TracedScene& scene, const std::vector<SurfacePoint>& points,
                                                              const NearestPoint& nearest, unsigned parts,
                                                              const TransportFocus& focus = {});

}  // namespace osgEnvLight
