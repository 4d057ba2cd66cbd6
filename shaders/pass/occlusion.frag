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
#include "pass/lobesums.glsl"
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
// A pixel's lobe in the frame of the lights.
struct Lobe {
    mat3 lightsFromLocal;
    vec3 view;      // local
    Bsdf bsdf;
    float dealt;    // weight of the lights that are not near it: in a narrow lobe's tails a pixel has too few, and they are noise
    int near;       // how many lights near its direction each pixel evaluates
    uvec4 nearest;  // their numbers, as in nearestLightMap
    uint nearOwn;   // bit i: light i of the pixel's own group is one of them
};

// Number of the k-th near light. No component is chosen by an index: software renderers would keep the vector in memory.
int nearLight(Lobe lobe, int k)
{
    uvec2 two = k < 8 ? lobe.nearest.xy : lobe.nearest.zw;
    return int(((k & 4) == 0 ? two.x : two.y) >> uint(8 * (k & 3)) & 255u);
}

Lobe lobeAt(ivec2 p, vec3 normal, int group)
{
    Lobe lobe;
    mat3 eyeFromLocal = frameAround(normal);
    lobe.lightsFromLocal = lightsFromEye() * eyeFromLocal;
    lobe.view = pixelView(p, eyeFromLocal);
    // Narrower lobes would see the nearest light alone, and show a step where another becomes the nearest.
    float roughness = max(texelFetch(normalMap, p, 0).a, 0.1);
    // What several scatterings add is the same for all lights.
    lobe.bsdf = makeBsdf(pixelBrdf(p), texelFetch(specularMap, p, 0).rgb, roughness, vec2(1.0, 0.0));
    lobe.dealt = smoothstep(DEALT_ROUGHNESS.x, DEALT_ROUGHNESS.y, roughness);
    lobe.near = 0;
    lobe.nearest = uvec4(0u);
    lobe.nearOwn = 0u;
#ifdef HAS_ATLAS
    if (roughness >= NEAR_LIGHTS_ROUGHNESS || lobe.bsdf.brdf == BRDF_LAMBERT) return lobe;
    int side = textureSize(nearestLightMap, 0).y;
    vec3 d = lobe.lightsFromLocal * vec3(-lobe.view.x, -lobe.view.y, lobe.view.z);
    ivec2 cell = min(ivec2(octahedralFromDirection(d) * float(side)), side - 1);
    lobe.near = NEAREST_LIGHTS;
    lobe.nearest = texelFetch(nearestLightMap, cell, 0);
    for (int k = 0; k < NEAREST_LIGHTS; ++k) {
        int light = nearLight(lobe, k);
        if (light % LIGHT_GROUPS == group) lobe.nearOwn |= 1u << uint(light / LIGHT_GROUPS);
    }
#endif
    return lobe;
}

// flux: of the light, times the cosine; direction: unit; count: of lights that it stands for.
void addToLobe(Lobe lobe, vec4 flux, vec3 direction, bool isSeen, float count, inout LobeLights sums)
{
    vec3 l = direction * lobe.lightsFromLocal;
    float alpha = lobe.bsdf.roughness * lobe.bsdf.roughness;
    // Times alpha^2, about one over the lobe's peak: the sums are kept in half floats.
    vec3 e = flux.rgb * bsdfLobe(lobe.bsdf, lobe.view, l) * (count * alpha * alpha);
    float s = flux.a * lobeShare(lobe.view, l, alpha) * count;
    float seen = isSeen ? 1.0 : 0.0;
    sums.seen += seen * e;
    sums.all += e;
    sums.sky += s * vec2(seen, 1.0);
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
    Lobe lobe = lobeAt(p, receiver.normal, group);
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
            seen = seen && atlasSees(light, point, normal, c) > 0.5;
#endif
            if (seen) sums.num += e;
#ifdef HAS_LOBES
            if (lobe.dealt > 0.0 && (lobe.nearOwn >> uint(i) & 1u) == 0u)
                addToLobe(lobe, e, direction, seen, lobe.dealt * float(LIGHT_GROUPS), lobeLights);
#endif
        }
    }
#endif
#if defined(HAS_LOBES) && defined(HAS_ATLAS)
    for (int k = 0; k < lobe.near; ++k) {
        int number = nearLight(lobe, k);
        AtlasLight light = atlasLight(number % LIGHT_GROUPS, number / LIGHT_GROUPS);
        float c = dot(normal, light.direction);
        if (c <= 0.0) continue;
        // At the rim of round bodies the maps' texels hide the surface from lights that graze it.
        bool seen = atlasSees(light, point, normal, c) > 0.5;
        addToLobe(lobe, c * vec4(light.flux, light.solidAngle), light.direction, seen, smoothstep(0.0, 0.1, c), lobeLights);
    }
#endif
#ifdef HAS_LOBES
    lobeTexel = packLobeLights(lobeLights);
#endif
    sumsTexel = packSums(sums);
    SumsPlace place;
    place.normal = receiver.normal;
    place.facet = pixelFacet(p, receiver.eye, receiver.normal, receiver.footprint);
    place.depth = texelFetch(depthMap, p, 0).r;
    placeTexel = packPlace(place);
}
