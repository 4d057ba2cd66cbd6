// SPDX-License-Identifier: MIT
#include "Mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scenes
{

unsigned Mesh::addVertex(const Vertex& vertex)
{
    _vertices.push_back(vertex);
    _vertices.back().normal.normalize();
    return static_cast<unsigned>(_vertices.size()) - 1;
}

void Mesh::addTriangle(unsigned a, unsigned b, unsigned c)
{
    const osg::Vec3d p = _vertices[a].position, q = _vertices[b].position, r = _vertices[c].position;
    const double longest = std::max({(q - p).length2(), (r - q).length2(), (p - r).length2()});
    const double shortest = std::min({(q - p).length2(), (r - q).length2(), (p - r).length2()});
    if (shortest > 1e-16 * longest) _indices.insert(_indices.end(), {a, b, c});
}

void Mesh::addQuad(const osg::Vec3d& corner, const osg::Vec3d& edgeU, const osg::Vec3d& edgeV)
{
    addGrid(1, 1, [&](unsigned i, unsigned j) { return Vertex{corner + edgeU * i + edgeV * j, edgeU ^ edgeV, {}}; });
}

void Mesh::addGrid(unsigned columns, unsigned rows, const std::function<Vertex(unsigned i, unsigned j)>& vertexAt)
{
    const unsigned first = static_cast<unsigned>(_vertices.size()), stride = columns + 1;
    for (unsigned j = 0; j <= rows; ++j)
        for (unsigned i = 0; i <= columns; ++i) addVertex(vertexAt(i, j));
    for (unsigned j = 0; j < rows; ++j)
        for (unsigned i = 0; i < columns; ++i) {
            const unsigned corner = first + j * stride + i;
            addTriangle(corner, corner + 1, corner + 1 + stride);
            addTriangle(corner, corner + 1 + stride, corner + stride);
        }
}

void Mesh::add(const Mesh& mesh, const osg::Matrixd& placement)
{
    const unsigned first = static_cast<unsigned>(_vertices.size());
    for (const Vertex& v : mesh._vertices)
        addVertex({v.position * placement, osg::Matrixd::transform3x3(v.normal, placement), v.texCoord});
    for (unsigned index : mesh._indices) _indices.push_back(first + index);
    _textured = _textured || mesh._textured;
}

void Mesh::setTexCoords(const std::function<osg::Vec2d(const osg::Vec3d& position)>& texCoordAt)
{
    for (Vertex& v : _vertices) v.texCoord = texCoordAt(v.position);
    _textured = true;
}

osg::ref_ptr<osg::Geometry> Mesh::geometry() const
{
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> texCoords = new osg::Vec2Array;
    for (const Vertex& v : _vertices) {
        positions->push_back(v.position);
        normals->push_back(v.normal);
        texCoords->push_back(v.texCoord);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    if (_textured) geometry->setTexCoordArray(0, texCoords, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, _indices.begin(), _indices.end()));
    return geometry;
}

std::vector<CurvePoint> smoothCurve(const std::vector<osg::Vec3d>& points, unsigned stepsPerSpan)
{
    const size_t last = points.size() - 1;
    std::vector<osg::Vec3d> slope(last);
    std::vector<double> length(last);
    for (size_t i = 0; i < last; ++i) {
        length[i] = (points[i + 1] - points[i]).length();
        slope[i] = (points[i + 1] - points[i]) / length[i];
    }
    std::vector<osg::Vec3d> tangent(last + 1, slope[0]);
    for (size_t i = 1; i < last; ++i)
        tangent[i] = (slope[i - 1] * length[i] + slope[i] * length[i - 1]) / (length[i - 1] + length[i]);
    if (last > 1) {
        tangent[0] = slope[0] * 1.5 - tangent[1] * 0.5;
        tangent[last] = slope[last - 1] * 1.5 - tangent[last - 1] * 0.5;
    }
    std::vector<CurvePoint> curve{{points[0], tangent[0]}};
    for (size_t i = 0; i < last; ++i)
        for (unsigned k = 1; k <= stepsPerSpan; ++k) {
            const double t = double(k) / stepsPerSpan, s = 1 - t;
            const osg::Vec3d a = tangent[i] * length[i], b = tangent[i + 1] * length[i];
            const osg::Vec3d position =
                points[i] * (s * s * (1 + 2 * t)) + a * (s * s * t) + points[i + 1] * (t * t * (1 + 2 * s)) - b * (t * t * s);
            const osg::Vec3d derivative =
                (points[i + 1] - points[i]) * (6 * s * t) + a * (s * (1 - 3 * t)) + b * (t * (1 - 3 * s));
            curve.push_back({position, derivative});
        }
    return curve;
}

namespace
{

// One smooth stretch of a profile, as (radius, 0, height). A mirrored neighbour makes a smooth end on the axis horizontal.
std::vector<CurvePoint> profileCurve(std::vector<osg::Vec3d> points, unsigned stepsPerSpan)
{
    if (points.size() == 2) return smoothCurve(points, 1);
    const auto mirrored = [](const osg::Vec3d& p) { return osg::Vec3d(-p.x(), 0, p.z()); };
    const bool front = points.front().x() == 0, back = points.back().x() == 0;
    if (front) points.insert(points.begin(), mirrored(points[1]));
    if (back) points.push_back(mirrored(points[points.size() - 2]));
    std::vector<CurvePoint> curve = smoothCurve(points, stepsPerSpan);
    if (front) curve.erase(curve.begin(), curve.begin() + stepsPerSpan);
    if (back) curve.erase(curve.end() - stepsPerSpan, curve.end());
    return curve;
}

// Cosine and sine that close exactly, so that the first and the last column of a surface of revolution meet.
osg::Vec2d onCircle(unsigned i, unsigned count)
{
    const double angle = 2 * osg::PI * (i % count) / count;
    return {std::cos(angle), std::sin(angle)};
}

void addRevolution(Mesh& mesh, const std::vector<CurvePoint>& curve, unsigned segments)
{
    const unsigned rows = static_cast<unsigned>(curve.size()) - 1;
    mesh.addGrid(segments, rows, [&](unsigned i, unsigned j) {
        const osg::Vec2d c = onCircle(i, segments);
        const osg::Vec3d p = curve[j].position, t = curve[j].tangent;
        const osg::Vec3d normal(t.z() * c.x(), t.z() * c.y(), -t.x());
        return Vertex{{p.x() * c.x(), p.x() * c.y(), p.z()}, normal, {}};
    });
}

}  // namespace

Mesh lathe(const std::vector<ProfilePoint>& profile, unsigned segments, unsigned stepsPerSpan)
{
    Mesh mesh;
    std::vector<osg::Vec3d> stretch;
    for (size_t i = 0; i < profile.size(); ++i) {
        stretch.emplace_back(profile[i].radius, 0, profile[i].height);
        const bool ends = profile[i].corner || i + 1 == profile.size();
        if (!ends || stretch.size() == 1) continue;
        addRevolution(mesh, profileCurve(stretch, stepsPerSpan), segments);
        stretch.erase(stretch.begin(), stretch.end() - 1);
    }
    return mesh;
}

namespace
{

constexpr std::array<std::array<int, 3>, 3> axesFrom{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};

// One face of a box whose edges follow a sphere: grid lines at equal angles from -45 to 0 degrees about the near inner corner,
// then from 0 to 45 about the far one.
void addBoxFace(Mesh& mesh, const osg::Vec3d& inner, double bevel, unsigned steps, const std::array<int, 3>& axes, double side)
{
    const auto tangent = [steps](unsigned i) {
        const double quarter = i <= steps ? double(i) / steps - 1 : double(i - steps - 1) / steps;
        return std::tan(quarter * osg::PI_4);
    };
    const auto sign = [steps](unsigned i) { return i <= steps ? -1.0 : 1.0; };
    mesh.addGrid(2 * steps + 1, 2 * steps + 1, [&](unsigned i, unsigned j) {
        osg::Vec3d normal, centre;
        normal[axes[0]] = side;
        normal[axes[1]] = side * tangent(i);
        normal[axes[2]] = tangent(j);
        normal.normalize();
        centre[axes[0]] = side * inner[axes[0]];
        centre[axes[1]] = side * sign(i) * inner[axes[1]];
        centre[axes[2]] = sign(j) * inner[axes[2]];
        return Vertex{centre + normal * bevel, normal, {}};
    });
}

void addSharpFace(Mesh& mesh, const osg::Vec3d& half, const std::array<int, 3>& axes, double side)
{
    osg::Vec3d edgeU, edgeV, corner = half * -side;
    edgeU[axes[1]] = 2 * side * half[axes[1]];
    edgeV[axes[2]] = 2 * half[axes[2]];
    corner[axes[0]] = side * half[axes[0]];
    corner[axes[2]] = -half[axes[2]];
    mesh.addQuad(corner, edgeU, edgeV);
}

}  // namespace

Mesh box(const osg::Vec3d& min, const osg::Vec3d& max, double bevel, unsigned steps)
{
    const osg::Vec3d half = (max - min) * 0.5, inner = half - osg::Vec3d(bevel, bevel, bevel);
    Mesh centred, placed;
    for (const std::array<int, 3>& axes : axesFrom)
        for (double side : {-1.0, 1.0}) {
            if (bevel > 0)
                addBoxFace(centred, inner, bevel, steps, axes, side);
            else
                addSharpFace(centred, half, axes, side);
        }
    placed.add(centred, (min + max) * 0.5);
    return placed;
}

Mesh sphere(double radius, unsigned steps)
{
    const osg::Vec3d corner(radius, radius, radius);
    return box(-corner, corner, radius, steps);
}

Mesh cylinder(double radius, double height, double bevel, unsigned segments)
{
    const double middle = bevel * (1 - std::sqrt(0.5));
    const std::vector<ProfilePoint> rounded{{0, 0, true},
                                            {radius - bevel, 0, true},
                                            {radius - middle, middle},
                                            {radius, bevel, true},
                                            {radius, height - bevel, true},
                                            {radius - middle, height - middle},
                                            {radius - bevel, height, true},
                                            {0, height, true}};
    const std::vector<ProfilePoint> sharp{{0, 0, true}, {radius, 0, true}, {radius, height, true}, {0, height, true}};
    return lathe(bevel > 0 ? rounded : sharp, segments, 2);
}

Mesh tube(const std::vector<osg::Vec3d>& points, double radius, unsigned segments, unsigned stepsPerSpan)
{
    std::vector<CurvePoint> curve = smoothCurve(points, points.size() == 2 ? 1 : stepsPerSpan);
    std::vector<osg::Vec3d> side;
    for (CurvePoint& c : curve) {
        c.tangent.normalize();
        const osg::Vec3d& t = c.tangent;
        const osg::Vec3d start = std::abs(t.z()) < 0.9 ? osg::Vec3d(0, 0, 1) : osg::Vec3d(1, 0, 0);
        const osg::Vec3d previous = side.empty() ? start : side.back();
        side.push_back(previous - t * (previous * t));
        side.back().normalize();
    }
    const unsigned last = static_cast<unsigned>(curve.size()) - 1;
    const auto around = [&](unsigned i, unsigned j) {
        const osg::Vec2d c = onCircle(i, segments);
        return side[j] * c.x() + (curve[j].tangent ^ side[j]) * c.y();
    };
    Mesh mesh;
    mesh.addGrid(segments, last, [&](unsigned i, unsigned j) {
        return Vertex{curve[j].position + around(i, j) * radius, around(i, j), {}};
    });
    mesh.addGrid(segments, 1, [&](unsigned i, unsigned j) {
        return Vertex{curve[0].position + around(i, 0) * (radius * j), -curve[0].tangent, {}};
    });
    mesh.addGrid(segments, 1, [&](unsigned i, unsigned j) {
        return Vertex{curve[last].position + around(i, last) * (radius * (1 - j)), curve[last].tangent, {}};
    });
    return mesh;
}

Mesh arch(double width, double height, double thickness, double radius, unsigned stepsPerQuarter)
{
    const unsigned eighth = (stepsPerQuarter + 1) / 2, columns = 4 * eighth;
    const auto onArch = [&](unsigned i) {
        const double angle = osg::PI * (columns - i) / columns;
        return osg::Vec3d(std::cos(angle), 0, std::sin(angle));
    };
    const auto onFrame = [&](unsigned i) {
        const double x = std::clamp((double(i) - 2 * eighth) / eighth, -1.0, 1.0) * width / 2;
        const double z = std::min({double(i), double(eighth), double(columns - i)}) / eighth * height;
        return osg::Vec3d(x, 0, z);
    };
    const osg::Vec3d front(0, -thickness / 2, 0);
    Mesh mesh;
    mesh.addGrid(columns, 1, [&](unsigned i, unsigned j) {
        return Vertex{front + (j == 0 ? onArch(i) * radius : onFrame(i)), {0, -1, 0}, {}};
    });
    mesh.addGrid(columns, 1, [&](unsigned i, unsigned j) {
        return Vertex{(j == 1 ? onArch(i) * radius : onFrame(i)) - front, {0, 1, 0}, {}};
    });
    mesh.addGrid(columns, 1, [&](unsigned i, unsigned j) {
        return Vertex{onArch(i) * radius + front * (2.0 * j - 1), -onArch(i), {}};
    });
    const osg::Vec3d pier(width / 2 - radius, 0, 0), depth(0, thickness, 0);
    mesh.addQuad(osg::Vec3d(-width / 2, 0, 0) + front, depth, pier);
    mesh.addQuad(osg::Vec3d(radius, 0, 0) + front, depth, pier);
    return mesh;
}

}  // namespace scenes
