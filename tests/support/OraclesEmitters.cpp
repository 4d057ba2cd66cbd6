// SPDX-License-Identifier: MIT
#include "Oracles.h"

#include <algorithm>
#include <cmath>

#include "Maths.h"

namespace testmaths::oracle
{

namespace
{

// a / b atan(c / b); where b is 0 and not a, its limit is not asked for.
double part(double a, double b, double c)
{
    return b > 0.0 ? a / b * std::atan(c / b) : 0.0;
}

}  // namespace

// 2 pi int cos^k cos sin dtheta = 2 pi / (k + 2).
double powerSky(double k)
{
    return 2.0 / (k + 2.0);
}

// Projected to the receiver's plane (Nusselt): half the unit disk, and half an ellipse of axes 1 and cos(tilt).
double halfSky(double tilt)
{
    return 0.5 * (1.0 + std::cos(tilt));
}

// int 2 pi r h^2 / (pi d^4) dr with u = d^2: h^2 (1 / h^2 - 1 / (h^2 + R^2)).
double coaxialDisk(double radius, double height)
{
    return radius * radius / (radius * radius + height * height);
}

// Clear of the horizon: the vector irradiance of a cone, pi sin^2 s, times cos w. Crossing: the part of its projection that
// is an ellipse, and the part of the unit disk's circle at the horizon (Lagarde, de Rousiers 2014; Snyder 1996).
double sphere(double angularRadius, double zenith)
{
    const double squareSin = std::sin(angularRadius) * std::sin(angularRadius);
    if (zenith + angularRadius <= 0.5 * pi) return squareSin * std::cos(zenith);
    if (zenith - angularRadius >= 0.5 * pi) return 0.0;
    const double x = std::cos(angularRadius) / std::sin(angularRadius);
    const double y = std::clamp(-x * std::cos(zenith) / std::sin(zenith), -1.0, 1.0);
    const double side = std::sin(zenith) * std::sqrt(1.0 - y * y);
    return (squareSin * (std::cos(zenith) * std::acos(y) - x * side) + std::atan2(side, x)) / pi;
}

// Lambert's sum over the edges: those at the corner below which the receiver lies have normals square to its own, the other
// two subtend the angles atan with the cosines a / sqrt(..), b / sqrt(..).
double rectangleCorner(double a, double b, double height)
{
    return (part(a, std::hypot(height, a), b) + part(b, std::hypot(height, b), a)) / (2.0 * pi);
}

// Four of the corners'.
double centredRectangle(double a, double b, double height)
{
    return 4.0 * rectangleCorner(0.5 * a, 0.5 * b, height);
}

// Lambert's sum: the edge at the horizon subtends 2 atan(w/x), its normal is the receiver's; the upper one 2 atan(w/d),
// d^2 = x^2 + h^2, at the cosine -x/d; the vertical ones count nothing.
double verticalRectangle(double distance, double halfWidth, double height)
{
    if (height == 0.0) return 0.0;
    const double upper = std::hypot(distance, height);
    return (std::atan2(halfWidth, distance) - distance / upper * std::atan(halfWidth / upper)) / pi;
}

// The double contour integral of ln(d^2) (Hottel; Howell's catalogue C-11).
double parallelRectangles(double a, double b, double distance)
{
    const double x = a / distance, y = b / distance;
    const double u = std::hypot(1.0, x), v = std::hypot(1.0, y);
    const double logarithm = std::log(u * v / std::sqrt(1.0 + x * x + y * y));
    const double angles = x * v * std::atan(x / v) + y * u * std::atan(y / u) - x * std::atan(x) - y * std::atan(y);
    return 2.0 / (pi * x * y) * (logarithm + angles);
}

// The double contour integral of ln(d^2) (Hamilton, Morgan 1952; Howell's catalogue C-14).
double perpendicularRectangles(double edge, double depth, double height)
{
    const double w = depth / edge, h = height / edge;
    const double ww = w * w, hh = h * h, all = 1.0 + ww + hh, d = std::hypot(w, h);
    const double logarithm = std::log((1.0 + ww) * (1.0 + hh) / all) + ww * std::log(ww * all / ((1.0 + ww) * (ww + hh))) +
                             hh * std::log(hh * all / ((1.0 + hh) * (ww + hh)));
    const double angles = w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - d * std::atan(1.0 / d);
    return (angles + 0.25 * logarithm) / (pi * w);
}

// Directions (cos p cos e, sin p, cos p sin e), solid angle cos p dp de; the wall is at elevations e below atan(H / a):
// int cos^2 p dp int sin e de / pi = (1 - cos atan(H / a)) / 2.
double wallOcclusion(double distance, double height)
{
    return halfPlaneAtEdge(std::atan2(height, distance));
}

// In the same directions: int cos^3 p dp int sin^2 e de / pi = 4/3 (e - sin e cos e) / (2 pi).
double wallOcclusionOfCosineSky(double distance, double height)
{
    const double e = std::atan2(height, distance);
    return 2.0 / (3.0 * pi) * (e - std::sin(e) * std::cos(e));
}

// All elevations up to the angle, in the directions of wallOcclusion().
double halfPlaneAtEdge(double angle)
{
    return 0.5 * (1.0 - std::cos(angle));
}

}  // namespace testmaths::oracle
