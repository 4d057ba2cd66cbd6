#version 330 compatibility
// SPDX-License-Identifier: MIT
// Each probe projects what it sees onto spherical harmonics, convolved with a cosine. A row is a probe. A texel has three
// coefficients, one in each target: their colour is that of radiance, their alpha that of the share that surfaces fill.
#include "lib/limits.glsl"

uniform sampler2D probeLinkMap;   // one row a probe: the number of the point that it sees in a direction; -1 the sky, -2 the inside of a body
uniform sampler2D probeBasisMap;  // a row for each texel of a probe: by what a direction counts for its three coefficients
uniform sampler2D pointRadianceMap;

layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    first = second = third = vec4(0.0);
    int count = textureSize(probeBasisMap, 0).x;
    for (int i = 0; i < count; ++i) {
        float link = texelFetch(probeLinkMap, ivec2(i, p.y), 0).r;
        if (link == -1.0) continue;
        int point = int(link);
        vec4 seen = vec4(0.0, 0.0, 0.0, 1.0);
        if (point >= 0) seen.rgb = texelFetch(pointRadianceMap, ivec2(point % POINT_SIDE, point / POINT_SIDE), 0).rgb;
        vec3 basis = texelFetch(probeBasisMap, ivec2(i, p.x), 0).rgb;
        first += basis.x * seen;
        second += basis.y * seen;
        third += basis.z * seen;
    }
}
