#version 330 compatibility
// SPDX-License-Identifier: MIT
// Each probe projects what it sees onto spherical harmonics, convolved with a cosine. A row is a probe. A texel has three
// coefficients, one in each target: their colour is that of radiance, their alpha that of the share that surfaces fill.
#include "lib/limits.glsl"

uniform sampler2D probeLinkMap;   // one row a probe, a texel a direction: 16-bit codes of what four rays see, as seenBy() reads them
uniform sampler2D probeBasisMap;  // a row for each texel of a probe: by what a direction counts for its three coefficients
uniform sampler2D pointRadianceMap;

layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;

// 0 is the inside of a body, 1 the sky, more than that a point. What is no sky fills a share.
vec4 seenBy(float code)
{
    int point = int(65535.0 * code + 0.5) - 2;
    if (point == -1) return vec4(0.0);
    if (point < 0) return vec4(0.0, 0.0, 0.0, 1.0);
    return vec4(texelFetch(pointRadianceMap, ivec2(point % POINT_SIDE, point / POINT_SIDE), 0).rgb, 1.0);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    first = second = third = vec4(0.0);
    int count = textureSize(probeBasisMap, 0).x;
    for (int i = 0; i < count; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, p.y), 0);
        vec4 seen = 0.25 * (seenBy(codes.r) + seenBy(codes.g) + seenBy(codes.b) + seenBy(codes.a));
        vec3 basis = texelFetch(probeBasisMap, ivec2(i, p.x), 0).rgb;
        first += basis.x * seen;
        second += basis.y * seen;
        third += basis.z * seen;
    }
}
