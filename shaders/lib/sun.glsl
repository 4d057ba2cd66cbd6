// SPDX-License-Identifier: MIT
// A disc of even radiance at infinity, as a sun or lamp that was cut from the map: what it sends a surface. In the surface's local
// frame where a function says so (normal +Z); unit radiance. lib/glint.glsl has what lobes reflect of it.
#ifndef SUN_GLSL
#define SUN_GLSL

#include "lib/constants.glsl"

// Irradiance over pi from a disc about a direction of that cosine to the normal, by sine and cosine of its angular radius; exact
// across the horizon [the sphere of systems.md A2].
float discIrradianceOverPi(float cosine, float sinS, float cosS)
{
    float sinW = sqrt(max(1.0 - cosine * cosine, 0.0));
    if (cosine >= sinS) return sinS * sinS * cosine;
    if (cosine <= -sinS) return 0.0;
    float t = sinS / cosS;
    float y = clamp(-cosine / (t * max(sinW, 1e-6)), -1.0, 1.0);
    float q = sinW * sqrt(max(1.0 - y * y, 0.0));
    // atan(q t) - q sin s cos s, whose terms of the first order cancel
    float z = q * t;
    float z2 = z * z;
    float series = z2 * (1.0 / 3.0 - z2 * (1.0 / 5.0 - z2 * (1.0 / 7.0 - z2 * (1.0 / 9.0 - z2 / 11.0))));
    float rest = z2 < 0.01 ? z * (t * t / (1.0 + t * t) - series) : atan(z) - q * sinS * cosS;
    return max((sinS * sinS * cosine * acos(y) + rest) * INV_PI, 0.0);
}

float discIrradianceOverPi(float cosine, float s)
{
    return discIrradianceOverPi(cosine, sin(s), cos(s));
}

// Share of the disc above the horizon, by its diameter.
float discShare(float cosine, float s)
{
    return clamp(0.5 + 0.5 * cosine / sin(s), 0.0, 1.0);
}

#endif
