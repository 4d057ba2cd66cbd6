#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces close to a surface point sent to it a bounce ago. Each texel is a point. The colour is the radiance that a white surface
// would send on of it. Alpha is the cosine-weighted share of directions that these surfaces fill.
#include "lib/limits.glsl"

// Of each point, side by side, what it sees in a direction: the number of a point, -1 for nothing close, or -2 for the inside of a body.
uniform sampler2D pointLinkMap;
uniform sampler2D pointRadianceMap;

layout(location = 0) out vec4 near;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    near = vec4(0.0);
    for (int k = 0; k < POINT_LINKS; ++k) {
        float link = texelFetch(pointLinkMap, ivec2(POINT_LINKS * p.x + k, p.y), 0).r;
        if (link == -1.0) continue;
        int point = int(link);
        vec3 sent = vec3(0.0);
        if (point >= 0) sent = texelFetch(pointRadianceMap, ivec2(point % POINT_SIDE, point / POINT_SIDE), 0).rgb;
        near += vec4(sent, 1.0);
    }
    near /= float(POINT_LINKS);
}
