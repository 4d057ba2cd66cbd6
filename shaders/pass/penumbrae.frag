#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, second part: where all about it see the same, that is it. All other pixels are marked.
#include "lib/limits.glsl"
#include "pass/sunpoints.glsl"

layout(location = 0) out vec4 visibility0;
layout(location = 1) out vec4 visibility1;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    ivec2 last = ivec2(viewportSize) - 1;
    visibility0 = vec4(1.0);
    visibility1 = vec4(1.0);
    bool even = true;
    for (int i = 0; i < sunCount; ++i) {
        float own = seenAt(i, p).x;
        even = even && sunAround(i, p, own, last).even;
        if (i < 4)
            visibility0[i] = own;
        else
            visibility1[i - 4] = own;
    }
    gl_FragDepth = even || isBackground(p) ? MARK_NONE : MARK_SURFACE;
}
