// SPDX-License-Identifier: MIT
// The number of the surface that a lobe's ray meets, and the lobe's roughness below 1, in one number.
#ifndef RAYSURFACE_GLSL
#define RAYSURFACE_GLSL

// From 1 on. A scene of 10^5 surfaces leaves roughness a 128th.
float packSurface(int surface, float roughness)
{
    return float(surface + 1) + clamp(roughness, 0.0, 1.0) * 0.99;
}

int packedSurface(float code)
{
    return int(code) - 1;
}

float packedRoughness(float code)
{
    return fract(code) / 0.99;
}

#endif
