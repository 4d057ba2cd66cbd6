// SPDX-License-Identifier: MIT
#include "surface/Outline.h"

#include "surface/Axes.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

double cross(const osg::Vec2d& a, const osg::Vec2d& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

osg::Vec3d meanOf(const std::vector<osg::Vec3d>& points)
{
    osg::Vec3d mean;
    for (const osg::Vec3d& p : points) mean += p / double(points.size());
    return mean;
}

double extentAbout(const osg::Vec3d& center, const std::vector<osg::Vec3d>& points)
{
    double extent = 0.0;
    for (const osg::Vec3d& p : points) extent = std::max(extent, (p - center).length());
    return extent;
}

}  // namespace

Outline::Outline(std::vector<osg::Vec3d> vertices) : _vertices(std::move(vertices))
{
    const double same = 1e-9 * extentAbout(meanOf(_vertices), _vertices);
    const auto repeats = [same](const osg::Vec3d& a, const osg::Vec3d& b) { return (a - b).length() <= same; };
    _vertices.erase(std::unique(_vertices.begin(), _vertices.end(), repeats), _vertices.end());
    while (_vertices.size() > 1 && repeats(_vertices.front(), _vertices.back())) _vertices.pop_back();
    const osg::Vec3d center = meanOf(_vertices);
    _extent = extentAbout(center, _vertices);
    // Newell's sum: twice the area as a vector.
    osg::Vec3d normal;
    for (size_t i = 0; i < _vertices.size(); ++i)
        normal += (_vertices[i] - center) ^ (_vertices[(i + 1) % _vertices.size()] - center);
    _area = 0.5 * normal.normalize();
    const osg::Vec3d x = besides(normal);
    const osg::Vec3d y = normal ^ x;
    for (const osg::Vec3d& p : _vertices) {
        _flat.emplace_back((p - center) * x, (p - center) * y);
        _height = std::max(_height, std::abs((p - center) * normal));
    }
}

bool Outline::isFlat() const
{
    return _height <= 1e-3 * _extent;
}

// Twice the signed area of a triangle.
double Outline::turn(size_t a, size_t b, size_t c) const
{
    return cross(_flat[b] - _flat[a], _flat[c] - _flat[a]);
}

bool Outline::crosses() const
{
    const size_t n = _flat.size();
    for (size_t i = 0; i < n; ++i)
        for (size_t k = i + 2; k < n; ++k) {
            const size_t j = (i + 1) % n, l = (k + 1) % n;
            if (turn(i, j, k) * turn(i, j, l) < 0.0 && turn(k, l, i) * turn(k, l, j) < 0.0) return true;
        }
    return false;
}

double Outline::turnAt(const std::vector<unsigned>& rest, size_t corner) const
{
    const size_t n = rest.size();
    return turn(rest[(corner + n - 1) % n], rest[corner], rest[(corner + 1) % n]);
}

// A corner that can be cut off: it points outwards, and no other vertex lies in its triangle.
bool Outline::isEar(const std::vector<unsigned>& rest, size_t corner) const
{
    const size_t n = rest.size();
    const unsigned a = rest[(corner + n - 1) % n], b = rest[corner], c = rest[(corner + 1) % n];
    if (turnAt(rest, corner) <= sliver()) return false;
    return std::none_of(rest.begin(), rest.end(), [&](unsigned p) {
        const bool isCorner = _flat[p] == _flat[a] || _flat[p] == _flat[b] || _flat[p] == _flat[c];
        return !isCorner && turn(a, b, p) >= -sliver() && turn(b, c, p) >= -sliver() && turn(c, a, p) >= -sliver();
    });
}

std::vector<unsigned> Outline::triangles() const
{
    std::vector<unsigned> rest, result;
    for (unsigned i = 0; i < _flat.size(); ++i) rest.push_back(i);
    while (rest.size() > 2) {
        const size_t n = rest.size();
        size_t cut = 0;
        while (cut < n && !isEar(rest, cut)) ++cut;
        if (cut < n) {
            result.insert(result.end(), {rest[(cut + n - 1) % n], rest[cut], rest[(cut + 1) % n]});
        } else {
            // What is left of the area is none: a corner on a straight edge.
            cut = 0;
            while (cut < n && std::abs(turnAt(rest, cut)) > sliver()) ++cut;
            if (cut == n) return {};
        }
        rest.erase(rest.begin() + std::ptrdiff_t(cut));
    }
    return result;
}

}  // namespace osgEnvLight
