#version 330 compatibility
// SPDX-License-Identifier: MIT
// Each probe adds up the light of the surface points that it sees, as spherical harmonics. A cosine is folded in. One row is a probe, one
// texel a coefficient: of radiance, and as alpha of where there is a surface.
#include "lib/limits.glsl"

uniform sampler2D probeLinkMap;   // one row a probe: the number of the point that it sees in a direction; -1 the sky, -2 the inside of a body
uniform sampler2D probeBasisMap;  // one row a coefficient: by what a direction counts
uniform sampler2D pointRadianceMap;

layout(location = 0) out vec4 coefficient;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    coefficient = vec4(0.0);
    int count = textureSize(probeBasisMap, 0).x;
    for (int i = 0; i < count; ++i) {
        float link = texelFetch(probeLinkMap, ivec2(i, p.y), 0).r;
        if (link == -1.0) continue;
        int point = int(link);
        vec3 radiance = vec3(0.0);
        if (point >= 0) radiance = texelFetch(pointRadianceMap, ivec2(point % POINT_SIDE, point / POINT_SIDE), 0).rgb;
        coefficient += texelFetch(probeBasisMap, ivec2(i, p.x), 0).r * vec4(radiance, 1.0);
    }
}
