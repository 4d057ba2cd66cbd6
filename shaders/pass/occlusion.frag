#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// O, first half: each pixel of a 4x4 cell takes its own group of the map's lights [seed 000, 3.2, fig. 3] and sums
// flux cos over the lights it sees (num) and over all of them (den). Their filtered ratio is the visibility of D. A light is
// blocked if the screen or its shadow map says so: bit by bit, so that no occluder counts twice [occlusion.md 4].
// Alpha: the same sums of solid angle cos, the ambient visibility. Of pixels with a lobe also the sums of flux times BRDF cos.
#pragma import_defines(HAS_ATLAS, OCCLUSION_SLICES, OCCLUSION_RAYS, OCCLUSION_POINTS, OCCLUSION_HORIZONS, OCCLUSION_BENT_NORMAL, HAS_LOBES, SLICES_1, SLICES_2, SLICES_3)
#if defined(OCCLUSION_HORIZONS) || defined(OCCLUSION_BENT_NORMAL)
#define OCCLUSION_SCALAR
#endif
#if defined(SLICES_1)
#define MOST_SLICES 1
#elif defined(SLICES_2)
#define MOST_SLICES 2
#elif defined(SLICES_3)
#define MOST_SLICES 3
#endif

#include "lib/bsdf.glsl"
#include "lib/frame.glsl"
#include "lib/limits.glsl"
#include "lib/opensky.glsl"
#include "lib/sequence.glsl"
#include "lib/slices.glsl"
#include "lib/visibility.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightsums.glsl"
#include "pass/lobelights.glsl"
#include "pass/lobewidth.glsl"
#ifdef HAS_ATLAS
#include "pass/atlas.glsl"
uniform float nearRadius;            // in texels of the atlas
uniform int nearTaps;
#else
uniform sampler2D occlusionLightMap; // rows 2q, 2q + 1: directions and flux of group q
#endif

uniform int occlusionTaps;
uniform int occlusionSteps;
uniform float occlusionRadius;       // in scene radii
uniform float occlusionThickness;    // in radii of the occlusion
uniform float sceneRadius;

layout(location = 0) out uvec4 sumsTexel;
layout(location = 1) out uvec4 placeTexel;
#ifdef HAS_LOBES
layout(location = 2) out uvec4 lobeTexel;
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
    v.slices = MOST_SLICES;
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

// Into the frame of the lights.
mat3 lightsFromEye()
{
#ifdef HAS_ATLAS
    return mat3(atlasFromEye);
#else
    return mapFromEye;
#endif
}

int lightCount()
{
#ifdef HAS_ATLAS
    return textureSize(atlasLightMap, 0).x;
#else
    return textureSize(occlusionLightMap, 0).x;
#endif
}

// Direction to light i of a group, of any length.
vec3 towardsLight(int group, int i)
{
#ifdef HAS_ATLAS
    return texelFetch(atlasLightMap, ivec2(i, 4 * group + 2), 0).xyz;
#else
    return texelFetch(occlusionLightMap, ivec2(i, 2 * group), 0).xyz;
#endif
}

// Bit i: light first + i of a group is above the horizon of normal. Pixels that run side by side take theirs together, one each
// turn of a loop, and none waits while another is busy with a light that it does not see.
uint lightsAbove(int group, int first, vec3 normal)
{
    uint above = 0u;
    int count = min(lightCount() - first, 32);
    for (int i = 0; i < count; ++i) above |= dot(normal, towardsLight(group, first + i)) > 0.0 ? 1u << i : 0u;
    return above;
}

// The number of the only bit that is set; findLSB() is of later versions of GLSL.
int bitNumber(uint bit)
{
    return int(floatBitsToUint(float(bit)) >> 23) - 127;
}

#ifdef HAS_LOBES
PixelLobe lobeAt(ivec2 p, vec3 normal, int group)
{
    mat3 eyeFromLocal = pixelFrame(p, normal);
    float roughness = max(texelFetch(normalMap, p, 0).a, LEAST_LIT_ROUGHNESS);
    // What several scatterings add is the same for all lights.
    Bsdf bsdf = makeBsdf(pixelBrdf(p), pixelF0(p), roughness, vec2(1.0, 0.0));
#ifdef HAS_ANISOTROPY
    bsdf.anisotropy = pixelAnisotropy(p).strength;
    if (bsdf.anisotropy > 0.0) bsdf.roughness = max(bsdf.roughness, LEAST_LIT_BRUSHED);
#endif
    PixelLobe lobe = pixelLobe(lightsFromEye() * eyeFromLocal, pixelView(p, eyeFromLocal), bsdf);
#ifdef HAS_ATLAS
    if (roughness < NEAR_LIGHTS_ROUGHNESS && bsdf.brdf != BRDF_LAMBERT) lobe = withNearLights(lobe, group);
#endif
    return lobe;
}
#endif

#ifdef OCCLUSION_BENT_NORMAL
// The share of the sky that is open, as if it were lit from about its middle.
LightSums bentSums(vec4 open, vec3 normal, int group)
{
    LightSums sums = LightSums(vec4(0.0), vec4(0.0));
    int count = lightCount();
    vec3 middle = normalize(open.xyz + 1e-20 * normal);
    for (int i = 0; i < count; ++i) {
#ifdef HAS_ATLAS
        AtlasLight light = atlasLight(group, i);
        vec4 e = vec4(light.flux, light.solidAngle);
        vec3 direction = light.direction;
#else
        vec4 e = vec4(texelFetch(occlusionLightMap, ivec2(i, 2 * group + 1), 0).rgb, 0.0);
        vec3 direction = towardsLight(group, i);
#endif
        sums.num += open.w * max(dot(middle, direction), 0.0) * e;
        sums.den += max(dot(normal, direction), 0.0) * e;
    }
    return sums;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    Receiver receiver = receiverAt(p);
    int group = bayer4(p.x, p.y);
    vec3 normal = lightsFromEye() * receiver.normal;
    SumsPlace place;
    place.normal = receiver.normal;
    place.facet = pixelFacet(p, receiver.eye, receiver.normal, receiver.footprint);
    place.depth = texelFetch(depthMap, p, 0).r;
#ifdef HAS_ATLAS
    vec3 facet = lightsFromEye() * place.facet;  // which the maps show: normals that were smoothed over edges lean through floors
#endif
#if defined(OCCLUSION_SLICES) || defined(OCCLUSION_SCALAR)
    Slices slices = pixelSlices(receiver, group);
#endif
#ifdef OCCLUSION_SCALAR
#ifdef OCCLUSION_HORIZONS
    for (int i = 0; i < slices.count; ++i) slices.slice[i] = belowHorizons(slices.slice[i]);
#endif
    vec4 open = openSky(slices, receiver.normal);
    open.xyz = lightsFromEye() * open.xyz;
#endif
#ifdef OCCLUSION_SLICES
    slices = rotated(lightsFromEye(), slices);
#endif
#if defined(OCCLUSION_RAYS) || defined(OCCLUSION_POINTS)
    RayMarch march = pixelRays(receiver);
#endif
#ifdef HAS_LOBES
    PixelLobe lobe = lobeAt(p, receiver.normal, group);
    LobeLights lobeLights = LobeLights(vec3(0.0), vec3(0.0), vec2(0.0));
#endif
#ifdef HAS_ATLAS
    vec3 point = vec3(atlasFromEye * vec4(receiver.eye, 1.0));
#endif
#ifdef OCCLUSION_BENT_NORMAL
    LightSums sums = bentSums(open, normal, group);
#else
    LightSums sums = LightSums(vec4(0.0), vec4(0.0));
    int count = lightCount();
    for (int first = 0; first < count; first += 32) {
        uint left = lightsAbove(group, first, normal);
        while (left != 0u) {
            int i = first + bitNumber(left & (~left + 1u));
            left &= left - 1u;
#ifdef HAS_ATLAS
            AtlasLight light = atlasLight(group, i);
            vec4 e = vec4(light.flux, light.solidAngle);
            vec3 direction = light.direction;
#else
            vec4 e = vec4(texelFetch(occlusionLightMap, ivec2(i, 2 * group + 1), 0).rgb, 0.0);
            vec3 direction = towardsLight(group, i);
#endif
            float c = dot(normal, direction);
            e *= c;
            sums.den += e;
            bool seen = true;
#ifdef OCCLUSION_SLICES
            seen = !sliceBlocks(slices, direction);
#endif
            // The points of neighbouring pixels and lights lie between each other.
#ifdef OCCLUSION_RAYS
            seen = seen && rayBlocked(depthMap, march, direction * lightsFromEye(), fract(float(group) * 0.0625 + float(i) * 0.61803399)) < 0.5;
#endif
#ifdef OCCLUSION_POINTS
            e *= 1.0 - pointHidden(depthMap, march, direction * lightsFromEye(), fract(float(group) * 0.0625 + float(i) * 0.61803399));
#endif
#ifdef OCCLUSION_HORIZONS
            e *= open.w;
#endif
#ifdef HAS_ATLAS
            seen = seen && atlasSees(light, point, facet) > 0.5;
#endif
            if (seen) sums.num += e;
#ifdef HAS_LOBES
            if (lobe.dealt > 0.0 && !isNear(lobe, i))
                addToLobe(lobe, e, direction, seen, lobe.dealt * float(LIGHT_GROUPS), lobeLights);
#endif
        }
    }
#endif
#if defined(HAS_LOBES) && defined(HAS_ATLAS)
    addNearLights(lobe, point, normal, facet, lobeLights);
#endif
#ifdef HAS_LOBES
    lobeTexel = packLobeLights(lobeLights);
#endif
    sumsTexel = packSums(sums);
    placeTexel = packPlace(place);
}
