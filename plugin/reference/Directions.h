// SPDX-License-Identifier: MIT
// Directions about a pole: the reference's own, which uses nothing of lib's sampling.
#pragma once

#include <cmath>
#include <limits>

#include <osg/Vec3d>
#include <glm/glm.hpp>

namespace osgEnvLight
{

inline glm::dvec3 toGlm(const osg::Vec3d& v)
{
    return glm::dvec3(v.x(), v.y(), v.z());
}

inline constexpr double pi = 3.14159265358979323846;

/** Cosine and sine of 2 pi turn, |turn| < 100, without a branch or a call: Taylor's series of an eighth of a turn, 1e-10 off. */
inline glm::dvec2 onCircle(double turn)
{
    const int quarter = int(4.0 * turn + 400.5) - 400;
    const double a = 0.5 * pi * (4.0 * turn - quarter), u = a * a;
    double c = 0.0, s = 0.0;
    for (int k = 10; k > 0; k -= 2) {
        c = (1.0 - c) * (u * (1.0 / (k * (k - 1))));
        s = (1.0 - s) * (u * (1.0 / (k * (k + 1))));
    }
    c = 1.0 - c;
    s = a * (1.0 - s);
    const double odd = quarter & 1, sign = 1 - (quarter & 2);
    return {sign * (c + odd * (-s - c)), sign * (s + odd * (c - s))};
}

/** Angle of (x, y) in turns, -1/2 to 1/2, 1e-10 off; 0 for (0, 0). Gregory's series of the angle that is left when a sixteenth of
 * a turn is taken off one in the first eighth. */
inline double turnOf(double y, double x)
{
    const double ax = std::abs(x), ay = std::abs(y);
    const double large = std::max(std::max(ax, ay), std::numeric_limits<double>::min()), small = std::min(ax, ay);
    const double k = 0.41421356237309503;  // tan(pi / 8)
    const double t = (small - k * large) / (large + k * small), u = t * t;
    double sum = 0.0;
    for (int i = 19; i > 0; i -= 2) sum = 1.0 / i - u * sum;
    double turn = 0.0625 + t * sum * (0.5 / pi);
    if (ay > ax) turn = 0.25 - turn;
    if (x < 0.0) turn = 0.5 - turn;
    return std::copysign(turn, y);
}

/** With the given cosine to +Z; turn in [0,1) is the azimuth. */
inline glm::dvec3 aboutPole(double cosine, double turn)
{
    return {std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) * onCircle(turn), cosine};
}

/** The same by height = 1 - cosine, which keeps its digits near the pole. */
inline glm::dvec3 aboutPoleByHeight(double height, double turn)
{
    const double s = std::sqrt(std::max(0.0, height * (2.0 - height)));
    return {s * onCircle(turn), 1.0 - height};
}

/** Columns: two unit vectors at right angles to the unit vector n and each other, and n [Duff et al. 2017]. The frame turns over
 * where few surfaces have their normal: at z = 0, as in the paper, rounding would change the samples of every wall. */
inline glm::dmat3 frameAbout(const glm::dvec3& n)
{
    const double sign = n.z < -0.7 ? -1.0 : 1.0;
    const double a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    return glm::dmat3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x,  //
                      b, sign + n.y * n.y * a, -n.y,                      //
                      n.x, n.y, n.z);
}

}  // namespace osgEnvLight
