#version 330 compatibility
// SPDX-License-Identifier: MIT
// Points that the view shows, evenly spread over the picture, in eye space; alpha 0: the background.
#include "lib/limits.glsl"
#include "pass/gbuffer.glsl"

layout(location = 0) out vec4 point;

void main()
{
    ivec2 size = textureSize(depthMap, 0); // viewportSize is this picture's
    ivec2 p = (ivec2(gl_FragCoord.xy) * 2 + 1) * size / (2 * PROBE_SIDE);
    vec2 ndc = (vec2(p) + 0.5) / vec2(size) * 2.0 - 1.0;
    point = isBackground(p) ? vec4(0.0) : vec4(eyeFromDepth(inverseProjection, ndc, texelFetch(depthMap, p, 0).r), 1.0);
}
