#version 330 compatibility
// SPDX-License-Identifier: MIT
// From the two surfaces of an emitter point's map to its heights, and how the first surface rises.
#include "lib/emittermap.glsl"

uniform sampler2D firstDepthMap;
uniform sampler2D firstSlopeMap;
uniform sampler2D secondDepthMap;
uniform ivec2 batchFromAtlas; // from this texel to the map's in the batch
uniform float mapTexel;       // its width at distance 1
uniform float mapOctaves;

layout(location = 0) out vec4 height;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy) + batchFromAtlas;
    vec3 slope = texelFetch(firstSlopeMap, p, 0).rgb;
    vec2 texel = emitterTexel(texelFetch(firstDepthMap, p, 0).r, texelFetch(secondDepthMap, p, 0).r, slope, mapTexel, mapOctaves);
    height = vec4(texel, 0.0, 0.0);
}
