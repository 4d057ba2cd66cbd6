#version 330 compatibility
// SPDX-License-Identifier: MIT
// What probes see of the surfaces as octahedral maps with a border of one texel, as pass/probegrid.glsl reads them.
#include "lib/limits.glsl"
#include "lib/octahedral.glsl"
#include "lib/sh.glsl"

uniform sampler2D harmonicsMap0;  // as pass/probeharmonics.frag
uniform sampler2D harmonicsMap1;
uniform sampler2D harmonicsMap2;
uniform int probeColumns;

layout(location = 0) out vec4 sent;  // radiance times share; share

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    int tile = PROBE_IRRADIANCE_SIDE + 2;
    ivec2 map = p / tile;
    int probe = map.y * probeColumns + map.x;
    sent = vec4(0.0);
    if (probe >= textureSize(harmonicsMap0, 0).y) return;
    ivec2 inner = foldedTexel(p - map * tile - 1, PROBE_IRRADIANCE_SIDE);
    vec3 d = directionFromOctahedral((vec2(inner) + 0.5) / float(PROBE_IRRADIANCE_SIDE));
    for (int i = 0; i < PROBE_HARMONICS / HARMONICS_TEXTURES; ++i) {
        sent += texelFetch(harmonicsMap0, ivec2(i, probe), 0) * shBasis18(3 * i, d);
        sent += texelFetch(harmonicsMap1, ivec2(i, probe), 0) * shBasis18(3 * i + 1, d);
        sent += texelFetch(harmonicsMap2, ivec2(i, probe), 0) * shBasis18(3 * i + 2, d);
    }
    sent = max(sent, vec4(0.0));  // they ring
    sent.a = min(sent.a, 1.0);
}
