// SPDX-License-Identifier: MIT
// The filter of the lights' sums along one direction. It averages a whole number of 4x4 cells and does not cross an edge. First
// rows are filtered, then columns of the result: on one surface that is the mean of the whole box.
#ifndef SUMSFILTER_GLSL
#define SUMSFILTER_GLSL
#pragma import_defines(COMBINE_SUBTRACT, COMBINE_SUM)

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightsums.glsl"

uniform usampler2D sumsMap;
uniform usampler2D placeMap;
uniform int filterCells;  // width of the box in cells

// Weighted sum of what lies along the direction (1, 0) or (0, 1): of ratios' terms as it is, else as a mean.
LightSums filteredSums(ivec2 p, ivec2 direction, SumsPlace place)
{
    vec2 ndc = pixelNdc(p);
    vec3 eye = eyeFromDepth(inverseProjection, ndc, place.depth);
    float footprint = pixelFootprint(inverseProjection, ndc, place.depth, viewportSize);
    PixelPlane plane = pixelPlane(eye, place.facet, 1.5 * footprint);
    int halfWidth = 2 * filterCells;
    ivec2 last = ivec2(viewportSize) - 1;
    LightSums mean = LightSums(vec4(0.0), vec4(0.0));
    float share = 0.0;
    int i = -halfWidth;
    do {
        ivec2 q = p + i * direction;
        ivec2 known = clamp(q, ivec2(0), last);
        SumsPlace there = unpackPlace(texelFetch(placeMap, known, 0));
        bool counts = q == known && there.depth < 1.0;
        float w = counts ? cellWeight(i, halfWidth) / float(2 * halfWidth) *
                  surfaceWeight(planeDistance(plane, q, there.depth), dot(place.normal, there.normal)) : 0.0;
        LightSums s = unpackSums(texelFetch(sumsMap, known, 0));
        mean.num += w * s.num;
        mean.den += w * s.den;
        share += w;
    } while (++i <= halfWidth);
#if defined(COMBINE_SUBTRACT) || defined(COMBINE_SUM)
    mean = LightSums(mean.num / share, mean.den / share);
#endif
    return mean;
}

#endif
