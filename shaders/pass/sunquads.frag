#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, second part. Each texel stands for a quad of 2x2 pixels. It is 1 if the quad is even: its pixels
// and those of the eight quads about it see all suns alike.
#include "pass/sunpoints.glsl"

layout(location = 0) out vec4 even;

void main()
{
    ivec2 p = 2 * ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(sunSeenMap0, 0) - 1;
    bool same = true;
    for (int i = 0; i < sunCount; ++i) {
        float own = seenAt(i, p).x;
        same = same && sunAround(i, p, own, last).even;
        // Where derivatives are coarse, the quad may not have noticed one of its own.
        for (int k = 1; k < 4; ++k) same = same && seenAt(i, min(p + ivec2(k & 1, k >> 1), last)).x == own;
    }
    even = vec4(same ? 1.0 : 0.0);
}
