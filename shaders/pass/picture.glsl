// SPDX-License-Identifier: MIT
// L = L_e + S + D - O [seed 000, eq. 3] and the bounce, from what the passes left, and the map behind the scene.
#ifndef PICTURE_GLSL
#define PICTURE_GLSL
#pragma import_defines(BACKGROUND_BLUR, HAS_SPECULAR, HAS_LOBES, HAS_REFLECTED, HAS_GATHERED, BACKGROUND)

#include "lib/constants.glsl"
#include "lib/latlong.glsl"
#include "lib/octahedral.glsl"
#include "pass/blockers.glsl"
#include "pass/gbuffer.glsl"
#include "pass/terms.glsl"

uniform sampler2D specularTermMap;
#ifdef HAS_REFLECTED
uniform sampler2D reflectedMap;  // what the scene sends into the lobe
#else
uniform sampler2D blockedLobeMap;
uniform sampler2D blockedCoatMap;
#endif
#ifdef HAS_GATHERED
uniform sampler2D gatheredMap;  // radiance that a white surface sends on of what others send
#endif
uniform sampler2D latlongMap;
uniform sampler2D pyramidMap;
uniform float pyramidSide;
uniform float pyramidLastLevel;
uniform float backgroundBlur;  // degrees

vec3 background(vec3 d)
{
#ifdef BACKGROUND_BLUR
    // The level whose texels are as wide as the blur
    float lod = log2(max(radians(backgroundBlur), 1e-6) * pyramidSide / sqrt(4.0 * PI));
    return pyramidLookup(pyramidMap, pyramidSide, pyramidLastLevel, d, lod) * radianceScale;
#else
    return textureLod(latlongMap, latlongFromDirection(d), 0.0).rgb * radianceScale;
#endif
}

vec3 specularTerm(ivec2 p)
{
#ifdef HAS_SPECULAR
    return texelFetch(specularTermMap, p, 0).rgb * radianceScale;
#else
    return vec3(0.0);
#endif
}

// What other surfaces send here, from all directions that are blocked: what the Lambert layer sends on of it, and the lobe.
vec3 bounce(ivec2 p)
{
    vec3 sent = vec3(0.0);
    vec3 n = pixelNormal(p);
#ifdef HAS_BLOCKERS
    vec3 rho = pixelAlbedo(p) * texelFetch(diffuseTermMap, p, 0).a;
#ifdef HAS_GATHERED
    sent += rho * texelFetch(gatheredMap, p, 0).rgb;
#else
    sent += rho * fromBlockers(p, n, 1.0 - ambientVisibility(p), radianceScale);
#endif
#endif
#if defined(HAS_REFLECTED)
    sent += texelFetch(reflectedMap, p, 0).rgb;
#elif defined(HAS_LOBES) && defined(HAS_BLOCKERS)
    vec3 ray = viewRay(inverseProjection, pixelNdc(p));
    sent += texelFetch(blockedLobeMap, p, 0).rgb * blockersAlong(p, reflect(ray, n), radianceScale);
#ifdef HAS_COATS
    if (isCoated(p)) sent += texelFetch(blockedCoatMap, p, 0).rgb * blockersAlong(p, reflect(ray, pixelCoatNormal(p)), radianceScale);
#endif
#endif
    return sent;
}

vec3 termSum(ivec2 p)
{
    return emitted(p) + specularTerm(p) + sunShaded(p) + occludedDiffuse(p) + bounce(p);
}

// Alpha: 0, where no surface is.
vec4 backgroundPicture(ivec2 p)
{
#ifdef BACKGROUND
    return vec4(background(mapFromEye * viewRay(inverseProjection, pixelNdc(p))), 0.0);
#else
    return vec4(0.0);
#endif
}

#endif
