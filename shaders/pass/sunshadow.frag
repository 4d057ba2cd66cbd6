#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, first part: by the point of each disc that is its own in a 4x4 cell. Two suns a
// target: share of the light, width of the penumbra in pixels.
#include "pass/sunpixel.glsl"

layout(location = 0) out vec4 seen0;
layout(location = 1) out vec4 seen1;
layout(location = 2) out vec4 seen2;
layout(location = 3) out vec4 seen3;

// Whether a value differs among the four pixels of a quad; where derivatives are coarse, one of the four may go unnoticed.
bool quadDiffers(float v)
{
    float across = abs(dFdx(v));
    return across + abs(dFdy(v)) + abs(dFdy(across)) > 0.0;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 seen[4] = vec4[4](vec4(1.0, 0.0, 1.0, 0.0), vec4(1.0, 0.0, 1.0, 0.0), vec4(1.0, 0.0, 1.0, 0.0),
                           vec4(1.0, 0.0, 1.0, 0.0));
    if (!isBackground(p)) {
        SunPixel s = sunPixel(p);
        for (int i = 0; i < sunCount; ++i) {
            vec2 v = sunSeen(i, s, 1);
            if ((i & 1) == 0)
                seen[i / 2].xy = v;
            else
                seen[i / 2].zw = v;
        }
    }
    // What only some of a 2x2 quad see is marked; derivatives are taken where all of its pixels are.
    for (int i = 0; i < 4; ++i) {
        seen[i].y = markedWidth(seen[i].y, quadDiffers(seen[i].x));
        seen[i].w = markedWidth(seen[i].w, quadDiffers(seen[i].z));
    }
    seen0 = seen[0];
    seen1 = seen[1];
    seen2 = seen[2];
    seen3 = seen[3];
}
