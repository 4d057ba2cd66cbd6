#version 330 compatibility
// SPDX-License-Identifier: MIT
// From the two surfaces of a map of the sky shadow atlas to its midpoint heights.
#include "lib/atlas.glsl"

uniform sampler2D firstDepthMap;
uniform sampler2D firstSlopeMap;
uniform sampler2D secondDepthMap;
uniform ivec2 batchFromAtlas; // from this texel to the map's in the batch

layout(location = 0) out vec4 height;

// What lights graze is let down by all that it rises within a texel: by less, and thin things shade themselves.
const float UNLIMITED = 1.0;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy) + batchFromAtlas;
    height = vec4(midpointHeight(texelFetch(firstDepthMap, p, 0).r, texelFetch(secondDepthMap, p, 0).r,
                                 texelFetch(firstSlopeMap, p, 0).r, UNLIMITED));
}
