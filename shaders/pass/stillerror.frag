#version 330 compatibility
// SPDX-License-Identifier: MIT
// First step to the standard error of a still view's average, from the spread of its frames: one texel for each block of the
// picture. The lights of the frames are spread better than by chance, so that the true error is smaller.

#include "lib/limits.glsl"
#include "lib/tone.glsl"
#include "pass/gbuffer.glsl"

uniform sampler2D accumulatedMap;
uniform sampler2D squareMap;
uniform float accumulatedWeight;
uniform float accumulatedFrames;  // so many of equal weight

layout(location = 0) out vec4 sums;  // squared error, luminance, 0, pixels with geometry


void main()
{
    sums = vec4(0.0);
    ivec2 size = textureSize(depthMap, 0);
    ivec2 block = ivec2(gl_FragCoord.xy);
    ivec2 to = size * (block + 1) / ERROR_BLOCKS;
    for (int y = size.y * block.y / ERROR_BLOCKS; y < to.y; ++y)
        for (int x = size.x * block.x / ERROR_BLOCKS; x < to.x; ++x) {
            ivec2 p = ivec2(x, y);
            if (isBackground(p)) continue;
            float mean = luminance(texelFetch(accumulatedMap, p, 0).rgb) / accumulatedWeight;
            float variance = max(texelFetch(squareMap, p, 0).r / accumulatedWeight - mean * mean, 0.0);
            sums += vec4(variance / max(accumulatedFrames - 1.0, 1.0), mean, 0.0, 1.0);
        }
}
