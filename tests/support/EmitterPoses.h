// SPDX-License-Identifier: MIT
// Flat lights beside a surface: in exact numbers, and as shaders get them.
#pragma once

#include <algorithm>
#include <vector>

#include "Maths.h"

namespace testmaths
{

/** A light's centre and two half axes or radii, in the local frame of a surface at the origin. */
template <class Vector>
struct FlatLight {
    Vector center, u, v;
};
using ExactLight = FlatLight<glsl::vec3>;
using SingleLight = FlatLight<glm::vec3>;

inline ExactLight exact(const SingleLight& l)
{
    return {glsl::vec3(l.center), glsl::vec3(l.u), glsl::vec3(l.v)};
}

inline SingleLight rounded(const ExactLight& l)
{
    return {glm::vec3(l.center), glm::vec3(l.u), glm::vec3(l.v)};
}

/** At distance 1, with two half axes at right angles; u has that length, v between half and one and a half of it. The lit side
 * sees the surface.*/
inline ExactLight randomLight(Random& random, double halfSize)
{
    ExactLight l;
    l.center = random.direction();
    glsl::vec3 w = random.direction();
    if (glsl::dot(w, l.center) > 0.0) w = -w;
    const glsl::vec3 x = glsl::normalize(glsl::cross(w, random.direction()));
    l.u = halfSize * x;
    l.v = halfSize * random.uniform(0.5, 1.5) * glsl::cross(w, x);
    return l;
}

/** The same about a surface that is ten times as far from the world's origin, in a frame that is not the world's: what a shader
 * finds from world coordinates in floats, and what those floats mean.*/
struct WorldPose {
    SingleLight found;
    ExactLight meant;
};

inline WorldPose throughWorld(Random& random, const ExactLight& light)
{
    const glsl::vec3 n = random.direction();
    const glsl::vec3 t = glsl::normalize(glsl::cross(n, random.direction()));
    const glsl::mat3 frame(t, glsl::cross(n, t), n);
    const glm::mat3 single(frame);
    const glm::vec3 origin(10.0 * random.direction());
    const glm::vec3 center(glsl::vec3(origin) + frame * light.center);
    const glm::vec3 u(frame * light.u), v(frame * light.v);
    WorldPose p;
    p.found = {glm::transpose(single) * (center - origin), glm::transpose(single) * u, glm::transpose(single) * v};
    const glsl::mat3 back = glsl::transpose(glsl::mat3(single));
    p.meant = {back * (glsl::vec3(center) - glsl::vec3(origin)), back * glsl::vec3(u), back * glsl::vec3(v)};
    return p;
}

inline double percentile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, size_t(share * double(values.size())))];
}

}  // namespace testmaths
