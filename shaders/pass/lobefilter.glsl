// SPDX-License-Identifier: MIT
// The filter of S along one direction: as that of the lights' sums, and between pixels only whose normals differ by less than the
// lobe is wide, and whose lobes are alike.
#ifndef LOBEFILTER_GLSL
#define LOBEFILTER_GLSL
#pragma import_defines(HAS_LOBE_LIGHTS)

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lobesums.glsl"
#include "pass/lobewidth.glsl"

uniform sampler2D estimateMap;  // sums of the map's radiance in the lobe, and of the weights
#ifdef HAS_LOBE_LIGHTS
uniform usampler2D lobeLightMap;
#endif
uniform int filterCells;  // width of the box in cells

struct LobeSums {
    vec4 estimate;
    LobeLights lights;
};

LobeSums filteredLobes(ivec2 p, ivec2 direction)
{
    vec4 here = texelFetch(normalMap, p, 0);
    vec3 normal = normalize(here.xyz * 2.0 - 1.0);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    vec3 eye = eyeFromDepth(inverseProjection, ndc, depth);
    PixelPlane plane = pixelPlane(eye, normal, 1.5 * pixelFootprint(inverseProjection, ndc, depth, viewportSize));
    float narrowness = lobeNarrowness(here.a, SHARED_TURN);
    float seenNarrowness = lobeNarrowness(here.a, SHARED_VISIBILITY_TURN);
    float viewTurn = pixelTurn(ndc);
    int halfWidth = 2 * filterCells;
    ivec2 last = ivec2(viewportSize) - 1;
    LobeSums sums = LobeSums(vec4(0.0), LobeLights(vec3(0.0), vec3(0.0), vec2(0.0)));
    int i = -halfWidth;
    do {
        ivec2 q = p + i * direction;
        ivec2 known = clamp(q, ivec2(0), last);
        vec4 there = texelFetch(normalMap, known, 0);
        float z = texelFetch(depthMap, known, 0).r;
        vec3 n = there.xyz * 2.0 - 1.0;
        float w = q == known && z < 1.0 ? cellWeight(i, halfWidth) * alikeWeight(here.a - there.a) *
                  surfaceWeight(planeDistance(plane, q, z), dot(normal, n)) : 0.0;
        float turn = lobeTurn(normal - n, abs(float(i)) * viewTurn);
        sums.estimate += w * lobeWeight(turn, narrowness) * texelFetch(estimateMap, known, 0);
#ifdef HAS_LOBE_LIGHTS
        LobeLights lights = unpackLobeLights(texelFetch(lobeLightMap, known, 0));
        w *= lobeWeight(turn, seenNarrowness);
        sums.lights.seen += w * lights.seen;
        sums.lights.all += w * lights.all;
        sums.lights.sky += w * lights.sky;
#endif
    } while (++i <= halfWidth);
    return sums;
}

#endif
