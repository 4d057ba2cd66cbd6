// SPDX-License-Identifier: MIT
#include "Isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scenes
{

namespace
{

using Index = std::array<unsigned, 3>;

class SurfaceNet
{
  public:
    SurfaceNet(const Field& field, const osg::BoundingBoxd& bounds, double cell)
        : _field(field), _origin(bounds._min), _cell(cell)
    {
        for (int a = 0; a < 3; ++a)
            _size[size_t(a)] = static_cast<unsigned>(std::ceil((bounds._max[a] - bounds._min[a]) / cell)) + 1;
        forEachCorner([this](const Index& at) { _values.push_back(_field(position(at))); });
    }

    Mesh mesh()
    {
        _vertexOfCell.assign(_values.size(), 0);
        forEachCorner([this](const Index& at) { addVertex(at); });
        forEachCorner([this](const Index& at) {
            for (unsigned axis = 0; axis < 3; ++axis) addFace(at, axis);
        });
        return _mesh;
    }

  private:
    template <typename Visit>
    void forEachCorner(const Visit& visit)
    {
        for (unsigned z = 0; z < _size[2]; ++z)
            for (unsigned y = 0; y < _size[1]; ++y)
                for (unsigned x = 0; x < _size[0]; ++x) visit(Index{x, y, z});
    }

    size_t flat(const Index& at) const { return at[0] + size_t(_size[0]) * (at[1] + size_t(_size[1]) * at[2]); }
    double value(const Index& at) const { return _values[flat(at)]; }
    osg::Vec3d position(const Index& at) const { return _origin + osg::Vec3d(at[0], at[1], at[2]) * _cell; }

    osg::Vec3d gradient(const osg::Vec3d& p) const
    {
        osg::Vec3d g;
        for (int a = 0; a < 3; ++a) {
            osg::Vec3d step;
            step[a] = _cell * 0.1;
            g[a] = (_field(p + step) - _field(p - step)) / (2 * step[a]);
        }
        return g;
    }

    // The mean of the crossings of the cell's twelve edges, moved onto the surface but not beyond the cell.
    void addVertex(const Index& at)
    {
        for (unsigned a = 0; a < 3; ++a)
            if (at[a] + 1 >= _size[a]) return;
        osg::Vec3d sum;
        double crossings = 0;
        for (unsigned edge = 0; edge < 12; ++edge) {
            const unsigned axis = edge / 4;
            Index from = at, to;
            from[(axis + 1) % 3] += edge & 1;
            from[(axis + 2) % 3] += edge >> 1 & 1;
            to = from;
            ++to[axis];
            const double a = value(from), b = value(to);
            if ((a < 0) == (b < 0)) continue;
            sum += position(from) + (position(to) - position(from)) * (a / (a - b));
            ++crossings;
        }
        if (crossings == 0) return;
        osg::Vec3d p = sum / crossings;
        const osg::Vec3d low = position(at), high = low + osg::Vec3d(_cell, _cell, _cell);
        for (int step = 0; step < 3; ++step) {
            const osg::Vec3d g = gradient(p);
            p -= g * (_field(p) / g.length2());
            for (int a = 0; a < 3; ++a) p[a] = std::clamp(p[a], low[a], high[a]);
        }
        _vertexOfCell[flat(at)] = _mesh.addVertex({p, gradient(p), {}});
    }

    // The four cells about an edge that crosses the surface, counter-clockwise seen from outside.
    void addFace(const Index& at, unsigned axis)
    {
        const unsigned b = (axis + 1) % 3, c = (axis + 2) % 3;
        Index to = at;
        ++to[axis];
        if (at[b] == 0 || at[c] == 0 || to[axis] >= _size[axis] || (value(at) < 0) == (value(to) < 0)) return;
        std::array<unsigned, 4> corner;
        for (unsigned k = 0; k < 4; ++k) {
            Index cell = at;
            cell[b] -= k == 0 || k == 3;
            cell[c] -= k < 2;
            corner[k] = _vertexOfCell[flat(cell)];
        }
        if (value(at) >= 0) std::swap(corner[1], corner[3]);
        _mesh.addTriangle(corner[0], corner[1], corner[2]);
        _mesh.addTriangle(corner[0], corner[2], corner[3]);
    }

    const Field& _field;
    osg::Vec3d _origin;
    double _cell;
    Index _size;
    std::vector<double> _values;
    std::vector<unsigned> _vertexOfCell;
    Mesh _mesh;
};

}  // namespace

Mesh isosurface(const Field& field, const osg::BoundingBoxd& bounds, double cell)
{
    return SurfaceNet(field, bounds, cell).mesh();
}

double smoothMin(double a, double b, double radius)
{
    const double overlap = std::max(radius - std::abs(a - b), 0.0);
    return std::min(a, b) - overlap * overlap / (4 * radius);
}

double smoothMax(double a, double b, double radius)
{
    return -smoothMin(-a, -b, radius);
}

}  // namespace scenes
