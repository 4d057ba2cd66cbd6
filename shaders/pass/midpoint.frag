#version 330 compatibility
// SPDX-License-Identifier: MIT
// From the two surfaces of a map of the sky shadow atlas to its heights, and how the first surface rises.
#include "lib/atlas.glsl"

uniform sampler2D firstDepthMap;
uniform sampler2D firstSlopeMap;
uniform sampler2D secondDepthMap;
uniform ivec2 batchFromAtlas; // from this texel to the map's in the batch

layout(location = 0) out vec4 height;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy) + batchFromAtlas;
    float texel = 1.0 / float(textureSize(firstDepthMap, 0).y);
    vec4 slope = texelFetch(firstSlopeMap, p, 0);
    float middle =
        skyHeight(texelFetch(firstDepthMap, p, 0).r, texelFetch(secondDepthMap, p, 0).r, slope.r, slope.g, texel);
    height = vec4(middle, packedRise(abs(slope.r), slope.b), 0.0, 0.0);
}
