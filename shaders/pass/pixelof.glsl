// SPDX-License-Identifier: MIT
#ifndef PIXELOF_GLSL
#define PIXELOF_GLSL

#include "pass/gbuffer.glsl"

// The pixel that shows a place in eye space on a surface with normal n; negative where none does.
ivec2 pixelOf(vec3 eye, vec3 n)
{
    vec4 clip = projection * vec4(eye, 1.0);
    vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * viewportSize;
    if (clip.w <= 0.0 || min(at.x, at.y) < 0.0 || at.x >= viewportSize.x || at.y >= viewportSize.y) return ivec2(-1);
    ivec2 q = ivec2(at);
    float depth = texelFetch(depthMap, q, 0).r;
    if (depth >= 1.0 || dot(pixelNormal(q), n) < 0.5) return ivec2(-1);
    PixelPlane plane = pixelPlane(eye, n, 1.5 * pixelFootprint(inverseProjection, pixelNdc(q), depth, viewportSize));
    return abs(planeDistance(plane, q, depth)) < 1.0 ? q : ivec2(-1);
}

#endif
