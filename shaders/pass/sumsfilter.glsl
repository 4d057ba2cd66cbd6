// SPDX-License-Identifier: MIT
// One direction of the filter of the lights' sums: a box that is a multiple of the 4x4 cell, which does not cross an edge. Along
// rows, then along columns of these: as exact as all of the box at once where it is one surface.
#ifndef SUMSFILTER_GLSL
#define SUMSFILTER_GLSL

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightsums.glsl"

uniform usampler2D sumsMap;
uniform usampler2D placeMap;
uniform int filterCells;  // width of the box in cells

// Weighted mean of what lies along the direction (1, 0) or (0, 1); place.share: of all weights that the box has.
LightSums filteredSums(ivec2 p, ivec2 direction, inout SumsPlace place)
{
    vec3 eye = pixelEye(p);
    float footprint = pixelFootprint(inverseProjection, pixelNdc(p), place.depth, viewportSize);
    PixelPlane plane = pixelPlane(eye, pixelFacet(p, eye, pixelNormal(p), footprint), 1.5 * footprint);
    int halfWidth = 2 * filterCells;
    ivec2 last = ivec2(viewportSize) - 1;
    LightSums mean = LightSums(vec4(0.0), vec4(0.0), vec2(0.0));
    float share = 0.0;
    int i = -halfWidth;
    do {
        ivec2 q = p + i * direction;
        ivec2 known = clamp(q, ivec2(0), last);
        uvec4 placeTexel = texelFetch(placeMap, known, 0);
        SumsPlace there = unpackPlace(placeTexel);
        bool counts = q == known && there.depth < 1.0;
        float w = counts ? cellWeight(i, halfWidth) / float(2 * halfWidth) *
                  surfaceWeight(planeDistance(plane, q, there.depth), dot(place.normal, there.normal)) : 0.0;
        LightSums s = unpackSums(texelFetch(sumsMap, known, 0), placeTexel);
        mean.num += w * s.num;
        mean.den += w * s.den;
        mean.lobe += w * s.lobe;
        share += w * there.share;
    } while (++i <= halfWidth);
    place.share = share;
    return mean;
}

#endif
