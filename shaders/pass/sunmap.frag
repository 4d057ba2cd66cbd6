#version 330 compatibility
// SPDX-License-Identifier: MIT
// From the two surfaces of a sun's shadow map: heights of the first, and of the middle.
#include "lib/atlas.glsl"
#include "lib/sunshadow.glsl"

uniform sampler2D firstDepthMap;
uniform sampler2D firstSlopeMap;
uniform sampler2D secondDepthMap;
uniform float mapTexel;       // in heights
uniform ivec2 batchFromAtlas; // from this texel to the map's in the batch

layout(location = 0) out vec4 heights;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy) + batchFromAtlas;
    float first = texelFetch(firstDepthMap, p, 0).r;
    vec4 slope = texelFetch(firstSlopeMap, p, 0);
    float middle = midpointHeight(first, texelFetch(secondDepthMap, p, 0).r, slope.r, slope.g, mapTexel);
    heights = first < 1.0 ? vec4(1.0 - first, middle, 0.0, 0.0) : vec4(SUN_NOTHING);
}
