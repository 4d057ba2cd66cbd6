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

// What a shadow catcher shows. light: the sum of what it reflects. In an empty scene it would reflect `alone`. The ratio of the two
// multiplies the map behind it. Where no map is shown, a black veil of that strength covers what the host has drawn.
vec4 shownBehind(ivec2 p, vec3 light)
{
    vec3 alone = diffuseTerm(p) + sunDiffuse(p);
    vec3 share = mix(vec3(1.0), light / max(alone, vec3(1e-20)), greaterThan(alone, vec3(0.0)));
#ifdef BACKGROUND
    return vec4(background(directionBehind(p)) * share, 0.0);  // the coverage of the map
#else
    float left = min(luminance(share), 1.0);
#ifndef VEIL_LINEAR
    left = srgbEncode3(vec3(left)).r;  // the host blends display values
#endif
    return vec4(vec3(0.0), 1.0 - left);
#endif
}
#endif

// sum: of the surface's terms. Alpha: coverage of what is behind the scene.
vec4 surfacePicture(ivec2 p, vec3 sum)
{
#ifdef HAS_CATCHERS
    if (isShadowCatcher(p)) return shownBehind(p, sum);
#endif
    return vec4(sum, 1.0);
}

#endif
