// SPDX-License-Identifier: MIT
// What remains of the sky in a pixel's slices, without regard to where its light comes from: the scalar ambient occlusion and
// the bent normal that others darken with [Jimenez et al. 2016; Landis 2002]. Kept for comparison.
#ifndef OPENSKY_GLSL
#define OPENSKY_GLSL

#include "lib/slices.glsl"

// A slice of which only the horizon on either side of the view ray counts: all below is blocked.
Slice belowHorizons(Slice s)
{
    int eye = int(floor(32.0 * (0.5 - s.tilt * INV_PI) - s.phase + 0.5));  // the sector of the view ray
    uint below = eye <= 0 ? 0u : eye >= 32 ? 0xffffffffu : (1u << eye) - 1u;
    uint left = s.bits & below;
    uint right = s.bits & ~below;
    for (int shift = 1; shift < 32; shift *= 2) {
        left |= left >> shift;
        right |= right << shift;
    }
    s.bits = left | right;
    return s;
}

// Cosine-weighted mean direction of the open sectors, as long as their share of the hemisphere's, and that share.
vec4 openSky(Slices r, vec3 normal)
{
    vec4 open = vec4(0.0);
    float all = 0.0;
    for (int i = 0; i < r.count; ++i) {
        Slice s = r.slice[i];
        for (int j = 0; j < 32; ++j) {
            float weight = sliceWeight(s, r.view, normal, float(j) / 32.0, float(j + 1) / 32.0);
            all += weight;
            if (((s.bits >> j) & 1u) != 0u) continue;
            float angle = ((float(j) + 0.5) / 32.0 - 0.5) * PI + s.tilt;
            open += weight * vec4(cos(angle) * r.view + sin(angle) * s.along, 1.0);
        }
    }
    return open / max(all, 1e-20);
}

#endif
