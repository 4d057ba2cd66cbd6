#version 330 compatibility
// SPDX-License-Identifier: MIT
// What glossy surfaces show of the picture, first part: one ray a pixel [indirect2.md 3, 6]. A narrow lobe's ray goes in the mirror
// direction; in wider lobes each pixel of a 4x4 cell takes another direction. Rays read this frame's picture, in which the lobes
// still show the mean radiance of what blocks light. No earlier frame is read, so nothing trails behind what moves.
#include "lib/frame.glsl"
#include "lib/march.glsl"
#include "lib/sequence.glsl"
#include "pass/gbuffer.glsl"
#include "pass/albedo.glsl"
#include "pass/lobewidth.glsl"

uniform sampler2D radianceMap;
uniform float sceneRadius;
uniform int reflectionSteps;

layout(location = 0) out vec4 reflection;  // radiance of what is met, times whether it is; whether

const float HIT_TOLERANCE = 0.5;  // distance from a surface's plane at which a ray still hits it, in widths of a pixel

// A direction of the lobe in its local frame; below the horizon it meets nothing.
vec3 lobeDirection(Bsdf b, vec3 v, int group)
{
    vec3 mirrored = vec3(-v.x, -v.y, v.z);
    if (b.roughness < NARROW_ROUGHNESS) return mirrored;
    vec2 u = cellPoint(0, float(group), 1) + vec2(1.0 / 32.0);
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (b.brdf == BRDF_PHONG || b.brdf == BRDF_STRAUSS)
        return frameAround(mirrored) * phongSample(phongExponent(b.roughness), u);
#endif
    vec3 h = ggxVisibleNormalSample(v, b.roughness * b.roughness, u);
    return 2.0 * dot(v, h) * h - v;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 n = pixelNormal(p);
    mat3 eyeFromLocal = frameAround(n);
    vec3 v = pixelView(p, eyeFromLocal);
    Bsdf b = makeBsdf(pixelBrdf(p), vec3(0.0), texelFetch(normalMap, p, 0).a, vec2(1.0, 0.0));
    int group = bayer4(p.x, p.y);
    vec3 d = lobeDirection(b, v, group);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    float footprint = pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    vec3 origin = eyeFromDepth(inverseProjection, ndc, depth) + (footprint + length(depthStep(inverseProjection, ndc, depth))) * n;
    ScreenRay ray = screenRay(projection, inverseProjection, viewportSize, origin, eyeFromLocal * d, 2.0 * sceneRadius,
                              HIT_TOLERANCE * footprint);
    reflection = vec4(0.0);
    if (d.z <= 0.0) return;
    // Points between those of its neighbours, where these are averaged; else as they, so that edges are lines.
    float phase = b.roughness < NARROW_ROUGHNESS ? 1.0 : (float(group) + 1.0) / 16.0;
    ScreenHit hit = screenRayHit(depthMap, normalMap, ray, reflectionSteps, phase);
    if (!hit.found) return;
    float share = smoothstep(0.0, 0.1, hit.border);  // fades where the picture ends
    reflection = share * vec4(texelFetch(radianceMap, hit.pixel, 0).rgb, 1.0);
}
