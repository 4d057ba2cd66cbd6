/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Vec2d>
#include <osg/Vec3d>

#include <vector>

namespace osgEnvLight
{

/** A polygon in a plane, as a closed line. */
class Outline
{
  public:
    /** In the plane through the mean of the vertices that fits them best. Seen against the normal they turn counter-clockwise. */
    explicit Outline(std::vector<osg::Vec3d> vertices);

    const std::vector<osg::Vec3d>& vertices() const { return _vertices; }  // without those that repeat the one before
    double area() const { return _area; }
    /** Largest distance of a vertex from the mean. */
    double extent() const { return _extent; }
    bool isFlat() const;
    /** Whether two edges cross each other. */
    bool crosses() const;
    /** Vertices of triangles that make it up, three each, as the outline turns; none if the outline meets itself so that there
     * are none.
     */
    std::vector<unsigned> triangles() const;

  private:
    double sliver() const { return 1e-12 * _extent * _extent; }  // twice the area of what is a line but for rounding
    double turn(size_t a, size_t b, size_t c) const;
    double turnAt(const std::vector<unsigned>& rest, size_t corner) const;
    bool isEar(const std::vector<unsigned>& rest, size_t corner) const;

    std::vector<osg::Vec3d> _vertices;
    std::vector<osg::Vec2d> _flat;
    double _area = 0.0;
    double _extent = 0.0;
    double _height = 0.0;  // of the vertices above or below the plane
};

}  // namespace osgEnvLight
