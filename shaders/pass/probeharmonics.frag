#version 330 compatibility
// SPDX-License-Identifier: MIT
// Each probe projects what it sees onto spherical harmonics, convolved with a cosine. A row is a probe. A texel has three
// coefficients, one in each target: their colour is that of radiance, their alpha that of the share that surfaces fill.
#include "lib/limits.glsl"
#include "pass/pointlink.glsl"

uniform sampler2D probeLinkMap;   // one row a probe, a texel a direction: 16-bit codes of what four rays see, as linkSends() reads them
uniform sampler2D probeBasisMap;  // a row for each texel of a probe: by what a direction counts for its three coefficients

layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    first = second = third = vec4(0.0);
    int count = textureSize(probeBasisMap, 0).x;
    for (int i = 0; i < count; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, p.y), 0);
        vec4 seen = 0.25 * (linkSends(codes.r) + linkSends(codes.g) + linkSends(codes.b) + linkSends(codes.a));
        vec3 basis = texelFetch(probeBasisMap, ivec2(i, p.x), 0).rgb;
        first += basis.x * seen;
        second += basis.y * seen;
        third += basis.z * seen;
    }
}
