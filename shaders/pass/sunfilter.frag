#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, second half: where it and its neighbours don't all see the same, 16 points of the disc of
// its own, and the neighbours' two as far as the penumbra is wider than they are apart: contact shadows stay sharp.
#include "lib/bilateral.glsl"
#include "pass/sunpixel.glsl"

uniform sampler2D sunSeenMap0;
uniform sampler2D sunSeenMap1;
uniform sampler2D sunSeenMap2;
uniform sampler2D sunSeenMap3;

layout(location = 0) out vec4 visibility0;
layout(location = 1) out vec4 visibility1;

vec2 seenAt(int sun, ivec2 q)
{
    int pair = sun / 2;
    vec4 v = pair == 0   ? texelFetch(sunSeenMap0, q, 0)
             : pair == 1 ? texelFetch(sunSeenMap1, q, 0)
             : pair == 2 ? texelFetch(sunSeenMap2, q, 0)
                         : texelFetch(sunSeenMap3, q, 0);
    return (sun & 1) == 0 ? v.xy : v.zw;
}

float visibilityOf(int sun, ivec2 p)
{
    ivec2 last = ivec2(viewportSize) - 1;
    float own = seenAt(sun, p).x;
    vec2 width = vec2(0.0);
    bool even = own <= 0.0 || own >= 1.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            vec2 v = seenAt(sun, clamp(p + ivec2(x, y), ivec2(0), last));
            even = even && v.x == own;
            width += (1.0 - v.x) * vec2(v.y, 1.0);
        }
    if (even) return own;
    SunPixel s = sunPixel(p);
    float reach = clamp(0.15 * width.x / max(width.y, 1e-6), 0.0, 2.0);
    vec2 sum = 16.0 * vec2(sunSeen(sun, s, 16).x, 1.0);
    if (reach <= 0.5) return sum.x / sum.y;
    vec3 eye = pixelEye(p);
    vec3 n = pixelNormal(p);
    vec3 facet = pixelFacet(p, eye, n, s.footprint);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            ivec2 q = p + ivec2(x, y);
            float w = clamp(reach + 0.5 - float(max(abs(x), abs(y))), 0.0, 1.0);
            if (w <= 0.0 || (x == 0 && y == 0) || q != clamp(q, ivec2(0), last) || isBackground(q)) continue;
            w *= geometryWeight(eye, facet, n, pixelEye(q), pixelNormal(q), s.footprint);
            sum += 2.0 * w * vec2(seenAt(sun, q).x, 1.0);
        }
    return sum.x / sum.y;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    visibility0 = vec4(1.0);
    visibility1 = vec4(1.0);
    if (isBackground(p)) return;
    for (int i = 0; i < sunCount; ++i) {
        float v = visibilityOf(i, p);
        if (i < 4)
            visibility0[i] = v;
        else
            visibility1[i - 4] = v;
    }
}
