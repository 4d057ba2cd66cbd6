// SPDX-License-Identifier: MIT
// The mean radiance of what blocks light in the picture [indirect.md 0].
#ifndef MEANRADIANCE_GLSL
#define MEANRADIANCE_GLSL

uniform sampler2D bounceMap;

// Seen from about d, in eye space. Surfaces count by how far they face it, (1 - d.n')/2: a floor is lit by walls, not by itself.
// What they send on in turn is a geometric series, at most of 20 terms' worth.
vec3 meanRadiance(vec3 d)
{
    vec4 all = texelFetch(bounceMap, ivec2(0), 0);
    vec4 facing = all;
    for (int k = 0; k < 3; ++k) facing -= d[k] * texelFetch(bounceMap, ivec2(k + 1, 0), 0);
    vec3 mean = max(facing.rgb, vec3(0.0)) / max(max(facing.a, 1e-4 * all.a), 1e-30);
    return mean / (1.0 - min(texelFetch(bounceMap, ivec2(4, 0), 0).rgb / max(all.a, 1e-30), 0.95));
}

#endif
