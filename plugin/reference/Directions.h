// SPDX-License-Identifier: MIT
// Directions about a pole: the reference's own, which uses nothing of lib's sampling.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace osgEnvLight
{

inline const double pi = std::acos(-1.0);

/** With the given cosine to +Z; turn in [0,1) is the azimuth. */
inline glm::dvec3 aboutPole(double cosine, double turn)
{
    const double s = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {s * std::cos(2.0 * pi * turn), s * std::sin(2.0 * pi * turn), cosine};
}

/** The same by height = 1 - cosine, which keeps its digits near the pole. */
inline glm::dvec3 aboutPoleByHeight(double height, double turn)
{
    const double s = std::sqrt(std::max(0.0, height * (2.0 - height)));
    return {s * std::cos(2.0 * pi * turn), s * std::sin(2.0 * pi * turn), 1.0 - height};
}

/** Columns: two unit vectors at right angles to the unit vector n and each other, and n. */
inline glm::dmat3 frameAbout(const glm::dvec3& n)
{
    const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 t = glm::normalize(glm::cross(other, n));
    return glm::dmat3(t, glm::cross(n, t), n);
}

}  // namespace osgEnvLight
