// SPDX-License-Identifier: MIT
// OpenGL's projections, as its specification prints them.
#pragma once

#include "glsl.h"

namespace testmaths
{

inline glsl::mat4 frustum(double l, double r, double b, double t, double n, double f)
{
    glsl::mat4 m(0.0);
    m[0][0] = 2.0 * n / (r - l);
    m[1][1] = 2.0 * n / (t - b);
    m[2] = glsl::vec4((r + l) / (r - l), (t + b) / (t - b), -(f + n) / (f - n), -1.0);
    m[3][2] = -2.0 * f * n / (f - n);
    return m;
}

/** frustum() with its far plane at infinity. */
inline glsl::mat4 endlessFrustum(double l, double r, double b, double t, double n)
{
    glsl::mat4 m = frustum(l, r, b, t, n, 2.0 * n);
    m[2][2] = -1.0;
    m[3][2] = -2.0 * n;
    return m;
}

inline glsl::mat4 orthographic(double l, double r, double b, double t, double n, double f)
{
    glsl::mat4 m(1.0);
    m[0][0] = 2.0 / (r - l);
    m[1][1] = 2.0 / (t - b);
    m[2][2] = -2.0 / (f - n);
    m[3] = glsl::vec4(-(r + l) / (r - l), -(t + b) / (t - b), -(f + n) / (f - n), 1.0);
    return m;
}

}  // namespace testmaths
