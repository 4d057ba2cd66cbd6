// SPDX-License-Identifier: MIT
// Orthonormal frames.
#ifndef FRAME_GLSL
#define FRAME_GLSL

// Columns t, b, n: a right-handed frame around the unit vector n, continuous but at n.z = 0 [Duff et al. 2017].
mat3 frameAround(vec3 n)
{
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// The frame turned about its third axis.
mat3 turnedFrame(mat3 frame, float angle)
{
    vec3 x = cos(angle) * frame[0] + sin(angle) * frame[1];
    return mat3(x, cross(frame[2], x), frame[2]);
}

#endif
