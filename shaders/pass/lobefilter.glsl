// SPDX-License-Identifier: MIT
// The filter of S along one direction. It averages a whole number of 4x4 cells, and pixels whose lobes are alike. With PREFILTERED it leaves
// the map's radiance out, which has no noise.
#ifndef LOBEFILTER_GLSL
#define LOBEFILTER_GLSL
#pragma import_defines(HAS_LOBE_LIGHTS, PREFILTERED)

#include "pass/lobeneighbours.glsl"
#include "pass/lobesums.glsl"

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
    LobeReceiver receiver = lobeReceiver(p);
#ifndef PREFILTERED
    float narrowness = lobeNarrowness(receiver.roughness, SHARED_TURN);
#endif
    float litRoughness = receiver.roughness;
#ifdef HAS_ANISOTROPY
    if (pixelAnisotropy(p).strength > 0.0) litRoughness = max(litRoughness, LEAST_LIT_BRUSHED);
#endif
    float seenNarrowness = lobeNarrowness(litRoughness, SHARED_VISIBILITY_TURN);
    int halfWidth = 2 * filterCells;
    ivec2 last = ivec2(viewportSize) - 1;
    LobeSums sums = LobeSums(vec4(0.0), LobeLights(vec3(0.0), vec3(0.0), vec2(0.0)));
    int i = -halfWidth;
    do {
        ivec2 q = p + i * direction;
        ivec2 known = clamp(q, ivec2(0), last);
        float turn;
        float w = lobeNeighbour(receiver, known, abs(float(i)), turn) * (q == known ? cellWeight(i, halfWidth) : 0.0);
#ifndef PREFILTERED
        sums.estimate += w * lobeWeight(turn, narrowness) * texelFetch(estimateMap, known, 0);
#endif
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
