// SPDX-License-Identifier: MIT
// What the pixels about one see of the suns by the one point of each disc that each asks [pass/sunshadow.frag].
#ifndef SUNPOINTS_GLSL
#define SUNPOINTS_GLSL
#pragma import_defines(SUNS_OVER_2, SUNS_OVER_4, SUNS_OVER_6)

#include "pass/sunpixel.glsl"

uniform sampler2D sunSeenMap0;
uniform sampler2D sunSeenMap1;
uniform sampler2D sunSeenMap2;
uniform sampler2D sunSeenMap3;

// Of a sun: the share of its light, the width of the penumbra.
vec2 seenAt(int sun, ivec2 q)
{
    vec4 v = texelFetch(sunSeenMap0, q, 0);
#ifdef SUNS_OVER_2
    if (sun >= 2) v = texelFetch(sunSeenMap1, q, 0);
#endif
#ifdef SUNS_OVER_4
    if (sun >= 4) v = texelFetch(sunSeenMap2, q, 0);
#endif
#ifdef SUNS_OVER_6
    if (sun >= 6) v = texelFetch(sunSeenMap3, q, 0);
#endif
    return (sun & 1) == 0 ? v.xy : v.zw;
}

// Of a neighbourhood of 5x5 pixels: whether all see as much of the sun as the one in its middle, by the 2x2 quads of which each
// says whether its own four agree; and what is hidden there, once weighted by the width of the penumbra.
struct SunAround {
    bool even;
    vec2 width;
};

SunAround sunAround(int sun, ivec2 p, float own, ivec2 last)
{
    SunAround around = SunAround(own <= 0.0 || own >= 1.0, vec2(0.0));
    for (int i = 0; i < 9; ++i) {
        vec2 v = seenAt(sun, clamp(p + 2 * ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last));
        around.even = around.even && v.x == own && v.y >= 0.0;
        around.width += (1.0 - v.x) * vec2(penumbraWidth(v.y), 1.0);
    }
    return around;
}

#endif
