// SPDX-License-Identifier: MIT
// Triangle meshes made by code: metres, Z up, counter-clockwise outward winding, unit normals.
#pragma once

#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Vec2d>
#include <osg/Vec3d>

#include <functional>
#include <vector>

namespace scenes
{

struct Vertex {
    osg::Vec3d position;
    osg::Vec3d normal;
    osg::Vec2d texCoord;
};

class Mesh
{
  public:
    unsigned addVertex(const Vertex& vertex);

    /// Triangles that touch one place with two corners, as at the pole of a sphere, are left out.
    void addTriangle(unsigned a, unsigned b, unsigned c);

    /// A flat parallelogram that faces along edgeU x edgeV.
    void addQuad(const osg::Vec3d& corner, const osg::Vec3d& edgeU, const osg::Vec3d& edgeV);

    /// (columns + 1) x (rows + 1) vertices that face along (direction of i) x (direction of j).
    void addGrid(unsigned columns, unsigned rows, const std::function<Vertex(unsigned i, unsigned j)>& vertexAt);

    /// The placement may turn, move and scale evenly.
    void add(const Mesh& mesh, const osg::Matrixd& placement = osg::Matrixd());
    void add(const Mesh& mesh, const osg::Vec3d& offset) { add(mesh, osg::Matrixd::translate(offset)); }

    void setTexCoords(const std::function<osg::Vec2d(const osg::Vec3d& position)>& texCoordAt);

    osg::ref_ptr<osg::Geometry> geometry() const;

  private:
    bool _textured = false;
    std::vector<Vertex> _vertices;
    std::vector<unsigned> _indices;
};

struct CurvePoint {
    osg::Vec3d position;
    osg::Vec3d tangent;
};

/// Cubic interpolation by chord length; two points give a straight line.
std::vector<CurvePoint> smoothCurve(const std::vector<osg::Vec3d>& points, unsigned stepsPerSpan);

struct ProfilePoint {
    double radius;
    double height;
    bool corner = false;
};

/// Turns a profile, listed from the bottom to the top, about the Z axis. The profile is smooth except at corners; a smooth one
/// that reaches the axis crosses it at a right angle.
Mesh lathe(const std::vector<ProfilePoint>& profile, unsigned segments, unsigned stepsPerSpan);

/// Edges and corners are rounded with the radius `bevel`; 0 leaves them sharp.
Mesh box(const osg::Vec3d& min, const osg::Vec3d& max, double bevel = 0, unsigned steps = 1);

Mesh sphere(double radius, unsigned steps);

/// Stands on the origin.
Mesh cylinder(double radius, double height, double bevel, unsigned segments);

/// A round tube along a smooth curve through the points, closed by flat ends.
Mesh tube(const std::vector<osg::Vec3d>& points, double radius, unsigned segments, unsigned stepsPerSpan);

/// A wall over a round arch: centred on x = 0 and y = 0, z from the springing line, 0, to `height`. Its sides and its top are
/// open, for they meet other walls.
Mesh arch(double width, double height, double thickness, double radius, unsigned stepsPerQuarter);

}  // namespace scenes
