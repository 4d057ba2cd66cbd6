#version 330 compatibility
// SPDX-License-Identifier: MIT
// What a surface receives of all area lights together, roughly: the bounds of pass/lightcuts.glsl are shares of it. One pixel of each 2x2
// is asked, one that shows a surface if there is any. Without any the value is huge.
#include "pass/gbuffer.glsl"
#include "pass/lightcuts.glsl"

uniform mat4 atlasFromEye;

layout(location = 0) out float total;

// No lobe asks here.
vec3 diffuseShare(vec3 toLight)
{
    return vec3(1.0);
}

void main()
{
    ivec2 last = textureSize(depthMap, 0) - 1;
    ivec2 p = 2 * ivec2(gl_FragCoord.xy);
    for (int k = 1; k < 4 && isBackground(p); ++k) p = min(2 * ivec2(gl_FragCoord.xy) + ivec2(k & 1, k >> 1), last);
    total = 3e38;
    if (isBackground(p)) return;
    vec2 ndc = (vec2(p) + 0.5) / vec2(last + 1) * 2.0 - 1.0;  // viewportSize is this picture's
    vec3 eye = eyeFromDepth(inverseProjection, ndc, texelFetch(depthMap, p, 0).r);
    vec3 n = mat3(atlasFromEye) * pixelNormal(p);
    total = roughlySent(vec3(atlasFromEye * vec4(eye, 1.0)), diffuseReceiver(n), lightTreeEnd());
}
