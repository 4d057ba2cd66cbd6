// SPDX-License-Identifier: MIT
// Beckmann's microfacet distribution with Smith's masking [Cook, Torrance 1982; Walter 2007, eq. 25-26]. Local frame as in
// lib/ggx.glsl.
#ifndef BECKMANN_GLSL
#define BECKMANN_GLSL

#include "lib/constants.glsl"
#include "lib/errorfunction.glsl"

// Density of normals per solid angle; integral of D cos = 1. 0 where the exponential would underflow.
float beckmannD(vec3 h, float alpha)
{
    float cos2 = max(h.z * h.z, 1e-12);
    float x = (h.x * h.x + h.y * h.y) / (alpha * alpha * cos2);
    return x < 80.0 ? exp(-x) / (PI * alpha * alpha * cos2 * cos2) : 0.0;
}

// cos (1 + 2 Lambda), which masking and the density of visible normals have in common; finite at the horizon.
float beckmannRoot(float cosTheta, float alpha)
{
    float sinTheta = sqrt(max(1.0 - cosTheta * cosTheta, 0.0));
    float a = min(cosTheta / max(alpha * sinTheta, 1e-12), 10.0);
    return cosTheta * errorFunction(a) + alpha * sinTheta * 0.56418958355 * exp(-a * a);  // 1 / sqrt(pi)
}

#endif
