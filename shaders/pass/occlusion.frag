#version 330 compatibility
// SPDX-License-Identifier: MIT
// O, first half: each pixel of a 4x4 cell takes its own group of the map's lights [seed 000, 3.2, fig. 3] and sums
// flux cos over the lights it sees (num) and over all of them (den). Their filtered ratio is the visibility of D.
#pragma import_defines(HAS_ATLAS)

#include "lib/sequence.glsl"
#include "lib/visibility.glsl"
#include "pass/gbuffer.glsl"
#ifdef HAS_ATLAS
#include "pass/atlas.glsl"
#endif

uniform sampler2D occlusionLightMap; // rows 2q, 2q + 1: directions and flux of group q
uniform int occlusionSteps;
uniform float occlusionRadius;       // in scene radii
uniform float occlusionThickness;    // in ray lengths
uniform float sceneRadius;

layout(location = 0) out vec4 num;
layout(location = 1) out vec4 den;

#ifdef HAS_ATLAS
void sumLights(ivec2 pixel, int group)
{
    // In the world about the atlas's origin
    vec3 p = vec3(atlasFromEye * vec4(pixelEye(pixel), 1.0));
    vec3 n = mat3(atlasFromEye) * pixelNormal(pixel);
    int count = textureSize(atlasLightMap, 0).x;
    for (int i = 0; i < count; ++i) {
        AtlasLight light = atlasLight(group, i);
        float c = dot(n, light.direction);
        if (c <= 0.0) continue;
        vec3 e = c * light.flux;
        den.rgb += e;
        num.rgb += e * atlasSees(light, p, n, c);
    }
}
#else
RayMarch rayMarch(ivec2 p, vec3 n)
{
    RayMarch march;
    march.projection = projection;
    march.inverseProjection = inverseProjection;
    march.size = viewportSize;
    march.radius = occlusionRadius * sceneRadius;
    march.thickness = occlusionThickness * march.radius;
    march.steps = occlusionSteps;
    float depth = texelFetch(depthMap, p, 0).r;
    vec2 ndc = pixelNdc(p);
    vec3 eye = eyeFromDepth(inverseProjection, ndc, depth);
    // The lift above the receiver's plane: a tenth of a pixel, and twice the step of a 24-bit depth buffer.
    float quantum = abs(eyeFromDepth(inverseProjection, ndc, depth - 1.2e-7).z - eye.z);
    float bias = 0.1 * pixelFootprint(inverseProjection, ndc, depth, viewportSize) + quantum;
    return rayMarchFrom(march, eye, n, bias);
}

void sumLights(ivec2 p, int group)
{
    vec3 n = pixelNormal(p);
    RayMarch march = rayMarch(p, n);
    mat3 eyeFromMap = transpose(mapFromEye);
    vec3 mapNormal = mapFromEye * n;
    int count = textureSize(occlusionLightMap, 0).x;
    for (int i = 0; i < count; ++i) {
        vec3 l = texelFetch(occlusionLightMap, ivec2(i, 2 * group), 0).xyz;
        float c = dot(mapNormal, l);
        if (c <= 0.0) continue;
        vec3 e = c * texelFetch(occlusionLightMap, ivec2(i, 2 * group + 1), 0).rgb;
        // The points of neighbouring pixels and lights lie between each other.
        float phase = fract(float(group) * 0.0625 + float(i) * 0.61803399);
        den.rgb += e;
        if (rayBlocked(depthMap, march, eyeFromMap * l, phase) < 0.5) num.rgb += e;
    }
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    num = vec4(0.0);
    den = vec4(0.0);
    if (isBackground(p)) return;
    sumLights(p, bayer4(p.x, p.y));
    den.a = 1.0;
}
