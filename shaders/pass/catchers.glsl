// SPDX-License-Identifier: MIT
// What a surface shows: the terms' sum, or, of a shadow catcher, the map behind it.
#ifndef CATCHERS_GLSL
#define CATCHERS_GLSL
#pragma import_defines(HAS_CATCHERS, MAP_ON_GROUND, BACKGROUND, VEIL_LINEAR)

#include "lib/tone.glsl"
#include "pass/picture.glsl"

#ifdef HAS_CATCHERS
#ifdef MAP_ON_GROUND
uniform vec4 mapCamera;  // where the map was taken from, in eye space, and how far from there on it is infinitely far
#endif

// Where the map shows what is behind a shadow catcher: along the ray, or where the map's camera saw this place.
vec3 directionBehind(ivec2 p)
{
    vec3 ray = viewRay(inverseProjection, pixelNdc(p));
#ifdef MAP_ON_GROUND
    vec3 seen = pixelEye(p) - vec3(mapCamera);
    float apart = max(length(seen), 1e-20);
    ray = normalize(mix(seen / apart, ray, smoothstep(0.25, 1.0, apart / mapCamera.w)));
#endif
    return mapFromEye * ray;
}

// What a shadow catcher shows of the map behind it. light: what it reflects, beside which is what it would reflect of the map if the
// scene were empty. Without the map a black veil is over what the host has behind.
vec4 shownBehind(ivec2 p, vec3 light)
{
    vec3 alone = diffuseTerm(p) + sunDiffuse(p);
    vec3 share = mix(vec3(1.0), light / max(alone, vec3(1e-20)), greaterThan(alone, vec3(0.0)));
#ifdef BACKGROUND
    return vec4(background(directionBehind(p)) * share, 0.0);  // as all of the map that is seen
#else
    float left = min(luminance(share), 1.0);
#ifndef VEIL_LINEAR
    left = srgbEncode3(vec3(left)).r;  // the host blends display values
#endif
    return vec4(vec3(0.0), 1.0 - left);
#endif
}
#endif

// Of the terms' sum. Alpha: coverage of what is behind.
vec4 surfacePicture(ivec2 p, vec3 sum)
{
#ifdef HAS_CATCHERS
    if (isCatcher(kindBrdf(pixelKind(p)), texelFetch(normalMap, p, 0).a)) return shownBehind(p, sum);
#endif
    return vec4(sum, 1.0);
}

#endif
