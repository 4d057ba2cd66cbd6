// SPDX-License-Identifier: MIT
// L = L_e + S + D - O [seed 000, eq. 3] and the bounce, from what the passes left, and the map behind the scene.
#ifndef PICTURE_GLSL
#define PICTURE_GLSL
#pragma import_defines(BACKGROUND_BLUR, HAS_SPECULAR, HAS_LOBES, HAS_REFLECTED, HAS_GATHERED, HAS_CATCHERS, BACKGROUND, OUTPUT_LINEAR)

#include "lib/constants.glsl"
#include "lib/latlong.glsl"
#include "lib/octahedral.glsl"
#include "lib/tone.glsl"
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

#ifdef HAS_CATCHERS
// What a shadow catcher shows of the map behind it. light: what it reflects, beside which is what it would reflect of the map if the
// scene were empty. Without the map a black veil is over what the host has behind.
vec4 shownBehind(ivec2 p, vec3 light)
{
    vec3 alone = diffuseTerm(p) + sunDiffuse(p);
    vec3 share = mix(vec3(1.0), light / max(alone, vec3(1e-20)), greaterThan(alone, vec3(0.0)));
#ifdef BACKGROUND
    return vec4(background(mapFromEye * viewRay(inverseProjection, pixelNdc(p))) * share, 1.0);
#else
    float left = min(luminance(share), 1.0);
#ifndef OUTPUT_LINEAR
    left = srgbEncode3(vec3(left)).r;  // the host blends display values
#endif
    return vec4(vec3(0.0), 1.0 - left);
#endif
}
#endif

// Of the terms' sum. Alpha: coverage.
vec4 surfacePicture(ivec2 p, vec3 sum)
{
#ifdef HAS_CATCHERS
    if (isCatcher(kindBrdf(pixelKind(p)), texelFetch(normalMap, p, 0).a)) return shownBehind(p, sum);
#endif
    return vec4(sum, 1.0);
}

vec4 backgroundPicture(ivec2 p)
{
#ifdef BACKGROUND
    return vec4(background(mapFromEye * viewRay(inverseProjection, pixelNdc(p))), 0.0);
#else
    return vec4(0.0);
#endif
}

#endif
