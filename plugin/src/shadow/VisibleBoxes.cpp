// SPDX-License-Identifier: MIT
#include "shadow/VisibleBoxes.h"

#include "surface/Caster.h"

#include <osg/Plane>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

const size_t mostBoxes = 256;  // more than so many are one

// What is in front of the plane [Sutherland, Hodgman 1974].
template <class Polygon, class Distance>
Polygon cut(const Polygon& polygon, const Distance& distance)
{
    Polygon result;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const auto& a = polygon[i];
        const auto& b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0.0) result.push_back(a);
        if ((da >= 0.0) == (db >= 0.0)) continue;
        const double t = da / (da - db);
        result.push_back({a.point + (b.point - a.point) * t, a.depth + (b.depth - a.depth) * t});
    }
    return result;
}

}  // namespace

osg::Vec3d ShadowView::at(double x, double y, double depth) const
{
    const osg::Matrixd inverse = osg::Matrixd::inverse(projection);
    const osg::Vec3d a = osg::Vec3d(x, y, -1.0) * inverse, b = osg::Vec3d(x, y, 0.5) * inverse;
    return (a + (b - a) * ((-depth - a.z()) / (b.z() - a.z()))) * worldFromEye;
}

double ShadowView::footprint(double depth) const
{
    return (at(0.0, 2.0 / height, depth) - at(0.0, 0.0, depth)).length();
}

// The view's four sides: their planes, facing inwards, and they themselves up to where the scene ends.
struct VisibleBoxes::Pyramid {
    std::array<osg::Plane, 4> planes;
    std::array<Polygon, 4> faces;
};

VisibleBoxes::VisibleBoxes(const CasterList& casters, const ShadowView& view)
    : _eyeFromWorld(osg::Matrixd::inverse(view.worldFromEye))
{
    const osg::BoundingBoxd& all = casters.bound;
    if (!all.valid()) return;
    double reach = 0.0;
    for (unsigned i = 0; i < 8; ++i) reach = std::max(reach, corner(all.corner(i)).depth);
    if (!(reach > 0.0)) return;

    Pyramid pyramid;
    const double x[] = {-1, 1, 1, -1}, y[] = {-1, -1, 1, 1};
    for (size_t i = 0; i < 4; ++i) {
        const size_t j = (i + 1) % 4;
        const osg::Vec3d a = view.at(x[i], y[i], reach), b = view.at(x[j], y[j], reach);
        pyramid.faces[i] = {corner(view.at(x[i], y[i], 0)), corner(view.at(x[j], y[j], 0)), corner(b), corner(a)};
        pyramid.planes[i] = osg::Plane(a, b, view.at(x[i], y[i], 0.5 * reach));
        if (pyramid.planes[i].distance(view.at(0, 0, reach)) < 0.0) pyramid.planes[i].flip();
    }
    if (casters.all.size() > mostBoxes)
        add(all, pyramid);
    else
        for (const Caster& caster : casters.all) add(boundOf(caster), pyramid);
}

VisibleBoxes::Corner VisibleBoxes::corner(const osg::Vec3d& point) const
{
    return {point, -(point * _eyeFromWorld).z()};
}

void VisibleBoxes::keep(const Polygon& polygon)
{
    if (polygon.empty()) return;
    for (const Corner& c : polygon) {
        _nearest = std::min(_nearest, c.depth);
        _farthest = std::max(_farthest, c.depth);
    }
    _polygons.push_back(polygon);
}

// The surface of a box within a view is the box's within the view, and the view's within the box.
void VisibleBoxes::add(const osg::BoundingBoxd& box, const Pyramid& pyramid)
{
    if (!box.valid()) return;
    for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned high = 0; high < 2; ++high) {
            const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, base = high << axis;
            Polygon face;
            for (unsigned k : {0u, u, u | v, v}) face.push_back(corner(box.corner(base | k)));
            face = cut(face, [](const Corner& c) { return c.depth; });
            for (const osg::Plane& plane : pyramid.planes)
                face = cut(face, [&](const Corner& c) { return plane.distance(c.point); });
            keep(face);
        }
    for (Polygon side : pyramid.faces) {
        for (int axis = 0; axis < 3; ++axis) {
            side = cut(side, [&](const Corner& c) { return c.point[axis] - box._min[axis]; });
            side = cut(side, [&](const Corner& c) { return box._max[axis] - c.point[axis]; });
        }
        keep(side);
    }
}

osg::BoundingBoxd VisibleBoxes::rectangle(const std::array<osg::Vec3d, 3>& axes, double depth) const
{
    osg::BoundingBoxd r;
    for (const Polygon& polygon : _polygons)
        for (const Corner& c : cut(polygon, [&](const Corner& corner) { return depth - corner.depth; }))
            r.expandBy(osg::Vec3d(c.point * axes[0], c.point * axes[1], 0.0));
    return r;
}

}  // namespace osgEnvLight
