// SPDX-License-Identifier: MIT
// The knight's head: the silhouette of a horse, extruded to a thickness that varies over it, with rounded edges.
#include "ChessPieces.h"

#include "Isosurface.h"

#include <algorithm>
#include <cmath>

namespace scenes
{

namespace
{

// Millimetres, x forward and z up, counter-clockwise seen from -Y.
const std::vector<osg::Vec3d> outline{
    {11, 0, 14},     {12.6, 0, 21},  {11.6, 0, 28},   {7.6, 0, 34.5},  {6.2, 0, 38.2},  {8, 0, 40.4},   {11.6, 0, 40.2},
    {15.4, 0, 38.2}, {18.2, 0, 38},  {19.6, 0, 39.8}, {20.8, 0, 42.4}, {20.2, 0, 45.4}, {17, 0, 49},    {13.2, 0, 53.6},
    {10.2, 0, 58.2}, {8.4, 0, 61},   {7.8, 0, 64.4},  {6.6, 0, 68.4},  {4.2, 0, 65.6},  {2.4, 0, 62.6}, {-2.2, 0, 61.4},
    {-7, 0, 57.8},   {-10.6, 0, 52}, {-12.6, 0, 45},  {-13, 0, 37},    {-12.2, 0, 29},  {-11.6, 0, 21}, {-11, 0, 14}};

struct Spot {
    double x, z, size, height;
};

// Half the thickness at places of the head, weighted by distance.
const std::vector<Spot> thickness{{0, 16, 6, 10.5},  {1, 25, 6, 8.8},  {-3, 38, 6, 7.6}, {-11, 45, 3, 4.2},
                                  {-11, 30, 3, 6.2}, {-5, 57, 3, 4.6}, {5, 47, 5, 7.2},  {9, 56, 3, 5.6},
                                  {14, 49, 3, 4.9},  {18, 42, 4, 4.6}, {6, 66, 2, 4.8},  {11, 40.5, 2, 4.4}};

// Bumps and hollows on both sides: jowl, brow, eye, eye socket, nostril, the hollow before the cheek.
const std::vector<Spot> relief{{4.2, 46, 4.8, 1.3},   {9.6, 56.4, 1.7, 0.9},  {9.4, 53.2, 2.6, -1.1}, {9.6, 53.3, 1.1, 2.1},
                               {18.4, 44.4, 1, -1.5}, {18.2, 44.6, 2.4, 0.9}, {12, 46.6, 2.4, -0.7},  {6.4, 64.6, 1.1, -1.2}};

struct Stroke {
    osg::Vec3d from, to;
    double size, depth;
};

// Grooves: the locks of the mane and its edge.
const std::vector<Stroke> grooves{{{-3.4, 0, 61}, {-0.6, 0, 54}, 0.75, 1.1},    {{-8, 0, 57}, {-3.2, 0, 50}, 0.75, 1.1},
                                  {{-11.4, 0, 51}, {-5.2, 0, 44.5}, 0.75, 1.1}, {{-13, 0, 44.4}, {-6.2, 0, 38}, 0.75, 1.1},
                                  {{-13.4, 0, 37.4}, {-6.2, 0, 31}, 0.75, 1.1}, {{-13, 0, 30.4}, {-5.6, 0, 24.6}, 0.75, 1.1},
                                  {{1.2, 0, 61}, {-2.2, 0, 50}, 1, 0.9},        {{-2.2, 0, 50}, {-4.8, 0, 38}, 1, 0.9},
                                  {{-4.8, 0, 38}, {-4.6, 0, 24}, 1, 0.9}};

double distanceToSegment(const osg::Vec3d& p, const osg::Vec3d& a, const osg::Vec3d& b)
{
    const osg::Vec3d ab = b - a;
    return (p - a - ab * std::clamp(((p - a) * ab) / ab.length2(), 0.0, 1.0)).length();
}

double outlineDistance(const std::vector<CurvePoint>& curve, const osg::Vec3d& p)
{
    double nearest = 1e9;
    bool inside = false;
    for (size_t i = 0, j = curve.size() - 1; i < curve.size(); j = i++) {
        const osg::Vec3d a = curve[i].position, b = curve[j].position;
        nearest = std::min(nearest, distanceToSegment(p, a, b));
        if ((a.z() > p.z()) != (b.z() > p.z()) && p.x() < a.x() + (p.z() - a.z()) * (b.x() - a.x()) / (b.z() - a.z()))
            inside = !inside;
    }
    return inside ? -nearest : nearest;
}

double bell(double distance, double size)
{
    return std::exp(-distance * distance / (size * size));
}

double halfThickness(const osg::Vec3d& p)
{
    double sum = 0, weights = 0;
    for (const Spot& s : thickness) {
        const double d2 = (p.x() - s.x) * (p.x() - s.x) + (p.z() - s.z) * (p.z() - s.z);
        const double weight = 1 / (d2 / (s.size * s.size) + 0.3);
        sum += weight * weight * s.height;
        weights += weight * weight;
    }
    double result = sum / weights;
    for (const Spot& s : relief) result += s.height * bell((p - osg::Vec3d(s.x, 0, s.z)).length(), s.size);
    for (const Stroke& g : grooves) result -= g.depth * bell(distanceToSegment(p, g.from, g.to), g.size);
    return result;
}

}  // namespace

Mesh horseHead()
{
    const std::vector<CurvePoint> curve = smoothCurve(outline, 4);
    const auto field = [&curve](const osg::Vec3d& p) {
        constexpr double rounding = 3.6;
        const osg::Vec3d flat(p.x(), 0, p.z());
        const double side = outlineDistance(curve, flat) + rounding, face = std::abs(p.y()) - halfThickness(flat) + rounding;
        const double body = std::min(std::max(side, face), 0.0) + std::hypot(std::max(side, 0.0), std::max(face, 0.0)) - rounding;
        const double mouth = distanceToSegment(flat, {13.6, 0, 42.2}, {22, 0, 41}) - 0.65;
        const double betweenEars = (p.z() - 61.8) * 0.45 - std::abs(p.y());
        return smoothMax(smoothMax(body, -mouth, 0.8), betweenEars, 1.2);
    };
    return isosurface(field, osg::BoundingBoxd(-15, -13, 12, 23, 13, 71), 0.8);
}

}  // namespace scenes
