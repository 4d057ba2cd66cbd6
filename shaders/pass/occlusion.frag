#version 330 compatibility
// SPDX-License-Identifier: MIT
// O, first half: each pixel of a 4x4 cell takes its own group of the map's lights [seed 000, 3.2, fig. 3] and sums
// flux cos over the lights it sees (num) and over all of them (den). Their filtered ratio is the visibility of D. A light is
// blocked if the screen or its shadow map says so: bit by bit, so that no occluder counts twice [occlusion.md 4].
// Alpha: the same sums of solid angle cos, the ambient visibility.
#pragma import_defines(HAS_ATLAS, OCCLUSION_SLICES, OCCLUSION_RAYS, OCCLUSION_POINTS, OCCLUSION_HORIZONS, OCCLUSION_BENT_NORMAL, HAS_LOBES)
#if defined(OCCLUSION_HORIZONS) || defined(OCCLUSION_BENT_NORMAL)
#define OCCLUSION_SCALAR
#endif

#include "lib/opensky.glsl"
#include "lib/sequence.glsl"
#include "lib/slices.glsl"
#include "lib/visibility.glsl"
#include "pass/gbuffer.glsl"
#ifdef HAS_ATLAS
#include "pass/atlas.glsl"
uniform float nearRadius;            // in texels of the atlas
uniform int nearTaps;
#else
uniform sampler2D occlusionLightMap; // rows 2q, 2q + 1: directions and flux of group q
#endif

uniform int occlusionSlices;
uniform int occlusionTaps;
uniform int occlusionSteps;
uniform float occlusionRadius;       // in scene radii
uniform float occlusionThickness;    // in radii of the occlusion
uniform float sceneRadius;

layout(location = 0) out vec4 num;
layout(location = 1) out vec4 den;
#ifdef HAS_LOBES
layout(location = 2) out vec4 lobe; // the same two sums of solid angle times the lobe that S integrates: not the light in it,
                                    // of which S knows more than these lights do
#endif

// The surface in a pixel, and how far it must be lifted: a tenth of a pixel, and twice the step of a 24-bit depth buffer.
struct Receiver {
    vec3 eye;
    vec3 normal;
    float footprint;
    float bias;
};

Receiver receiverAt(ivec2 p)
{
    float depth = texelFetch(depthMap, p, 0).r;
    vec2 ndc = pixelNdc(p);
    Receiver r;
    r.eye = eyeFromDepth(inverseProjection, ndc, depth);
    r.normal = pixelNormal(p);
    r.footprint = pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    float quantum = abs(depthStep(inverseProjection, ndc, depth).z);
    r.bias = 0.1 * r.footprint + quantum;
    return r;
}

Slices pixelSlices(Receiver r, int group)
{
    SliceView v;
    v.projection = projection;
    v.inverseProjection = inverseProjection;
    v.size = viewportSize;
#ifdef HAS_ATLAS
    v.radius = nearRadius * atlasTexelAt(vec3(atlasFromEye * vec4(r.eye, 1.0)));
    v.thickness = 0.25 * v.radius;
    v.taps = nearTaps;
#else
    v.radius = occlusionRadius * sceneRadius;
    v.thickness = occlusionThickness * v.radius;
    v.taps = occlusionTaps;
#endif
    v.slices = occlusionSlices;
    v.group = group;
    return slicesOf(depthMap, normalMap, v, r.eye, r.normal, r.bias, r.footprint);
}

RayMarch pixelRays(Receiver r)
{
    RayMarch march;
    march.projection = projection;
    march.inverseProjection = inverseProjection;
    march.size = viewportSize;
    march.radius = occlusionRadius * sceneRadius;
    march.thickness = occlusionThickness * march.radius;
    march.steps = occlusionSteps;
    return rayMarchFrom(march, r.eye, r.normal, r.bias);
}

// Light i of a group: direction in eye space.
struct Light {
    vec3 direction;
    vec3 flux;
    float solidAngle;
};

#ifdef HAS_ATLAS
Light lightOf(AtlasLight a)
{
    Light light;
    light.direction = transpose(mat3(atlasFromEye)) * a.direction;
    light.flux = a.flux;
    light.solidAngle = a.solidAngle;
    return light;
}
#else
Light lightAt(int group, int i)
{
    Light light;
    light.direction = transpose(mapFromEye) * texelFetch(occlusionLightMap, ivec2(i, 2 * group), 0).xyz;
    light.flux = texelFetch(occlusionLightMap, ivec2(i, 2 * group + 1), 0).rgb;
    light.solidAngle = 0.0;
    return light;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    num = vec4(0.0);
    den = vec4(0.0);
#ifdef HAS_LOBES
    lobe = vec4(0.0);
#endif
    if (isBackground(p)) return;

    Receiver receiver = receiverAt(p);
    int group = bayer4(p.x, p.y);
#if defined(OCCLUSION_SLICES) || defined(OCCLUSION_SCALAR)
    Slices slices = pixelSlices(receiver, group);
#endif
#ifdef OCCLUSION_SCALAR
#ifdef OCCLUSION_HORIZONS
    for (int i = 0; i < slices.count; ++i) slices.slice[i] = belowHorizons(slices.slice[i]);
#endif
    vec4 open = openSky(slices, receiver.normal);
#endif
#if defined(OCCLUSION_RAYS) || defined(OCCLUSION_POINTS)
    RayMarch march = pixelRays(receiver);
#endif
#ifdef HAS_LOBES
    bool glossy = pixelBrdf(p) != BRDF_LAMBERT;
    float roughness = texelFetch(normalMap, p, 0).a;
    vec3 view = -viewRay(inverseProjection, pixelNdc(p));
#endif
#ifdef HAS_ATLAS
    vec3 point = vec3(atlasFromEye * vec4(receiver.eye, 1.0));
    vec3 normal = mat3(atlasFromEye) * receiver.normal;
    int count = textureSize(atlasLightMap, 0).x;
#else
    int count = textureSize(occlusionLightMap, 0).x;
#endif
    for (int i = 0; i < count; ++i) {
#ifdef HAS_ATLAS
        AtlasLight mapped = atlasLight(group, i);
        Light light = lightOf(mapped);
#else
        Light light = lightAt(group, i);
#endif
        float c = dot(receiver.normal, light.direction);
#ifdef OCCLUSION_BENT_NORMAL
        // The share of the sky that is open, as if it were lit from about its middle.
        num += open.w * max(dot(normalize(open.xyz + 1e-20 * receiver.normal), light.direction), 0.0) *
               vec4(light.flux, light.solidAngle);
        den += max(c, 0.0) * vec4(light.flux, light.solidAngle);
        continue;
#endif
        if (c <= 0.0) continue;
        vec4 e = c * vec4(light.flux, light.solidAngle);
        den += e;
#ifdef HAS_LOBES
        float l = glossy ? e.a * lobeShare(receiver.normal, view, light.direction, roughness) : 0.0;
        lobe.g += l;
#endif
#ifdef OCCLUSION_SLICES
        if (sliceBlocks(slices, light.direction)) continue;
#endif
#ifdef OCCLUSION_RAYS
        // The points of neighbouring pixels and lights lie between each other.
        float phase = fract(float(group) * 0.0625 + float(i) * 0.61803399);
        if (rayBlocked(depthMap, march, light.direction, phase) > 0.5) continue;
#endif
#ifdef OCCLUSION_POINTS
        e *= 1.0 - pointHidden(depthMap, march, light.direction, fract(float(group) * 0.0625 + float(i) * 0.61803399));
#endif
#ifdef OCCLUSION_HORIZONS
        e *= open.w;
#endif
#ifdef HAS_ATLAS
        if (atlasSees(mapped, point, normal, c) < 0.5) continue;
#endif
        num += e;
#ifdef HAS_LOBES
        lobe.r += l;
#endif
    }
}
