// SPDX-License-Identifier: MIT
// The mean of a map over whole 4x4 cells about a pixel. Pixels that show another surface are left out.
#ifndef CELLMEAN_GLSL
#define CELLMEAN_GLSL

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"

// halfWidth: 2 is one cell, 4 is 2x2 of them.
vec4 cellMean(sampler2D map, ivec2 p, int halfWidth)
{
    vec3 n = pixelNormal(p);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    vec3 eye = eyeFromDepth(inverseProjection, ndc, depth);
    PixelPlane plane = pixelPlane(eye, n, 1.5 * pixelFootprint(inverseProjection, ndc, depth, viewportSize));
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -halfWidth; y <= halfWidth; ++y)
        for (int x = -halfWidth; x <= halfWidth; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last);
            float there = texelFetch(depthMap, q, 0).r;
            if (q != p + ivec2(x, y) || there >= 1.0) continue;
            float w = cellWeight(x, halfWidth) * cellWeight(y, halfWidth) * surfaceWeight(planeDistance(plane, q, there), dot(n, pixelNormal(q)));
            sum += w * texelFetch(map, q, 0);
            weights += w;
        }
    return sum / weights;
}

#endif
