#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, third part. Where its quad is even [pass/sunquads.frag], a pixel keeps what it sees by its own
// point of the disc. All other pixels are marked.
#include "lib/limits.glsl"
#include "pass/sunpoints.glsl"

uniform sampler2D sunQuadMap;

layout(location = 0) out vec4 visibility0;
layout(location = 1) out vec4 visibility1;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    visibility0 = vec4(1.0);
    visibility1 = vec4(1.0);
    for (int i = 0; i < sunCount; ++i) {
        float own = seenAt(i, p).x;
        if (i < 4)
            visibility0[i] = own;
        else
            visibility1[i - 4] = own;
    }
    bool even = texelFetch(sunQuadMap, p / 2, 0).r > 0.5;
    gl_FragDepth = even || isBackground(p) ? MARK_NONE : MARK_SURFACE;
}
