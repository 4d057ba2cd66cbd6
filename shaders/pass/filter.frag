#version 330 compatibility
// SPDX-License-Identifier: MIT
// O, second half: num and den filtered by a box that is a multiple of the 4x4 cell, without crossing an edge, and
// divided after the filter (systems.md E3); or, as printed in seed 000, the occluded irradiance over pi.
#pragma import_defines(COMBINE_SUBTRACT, HAS_LOBES)

#include "lib/bilateral.glsl"
#include "lib/constants.glsl"
#include "pass/gbuffer.glsl"

uniform sampler2D numMap;
uniform sampler2D denMap;
uniform sampler2D lobeMap;
uniform int filterCells; // width of the box in cells

layout(location = 0) out vec4 occlusion;
#ifdef HAS_LOBES
layout(location = 1) out vec4 lobeSeen;
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    occlusion = vec4(1.0);
#ifdef HAS_LOBES
    lobeSeen = vec4(1.0);
#endif
    if (isBackground(p)) return;
    vec3 eye = pixelEye(p);
    vec3 n = pixelNormal(p);
    float footprint = pixelFootprint(inverseProjection, pixelNdc(p), texelFetch(depthMap, p, 0).r, viewportSize);
    vec3 facet = pixelFacet(p, eye, n, footprint);
    int halfWidth = 2 * filterCells;
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 num = vec4(0.0);
    vec4 den = vec4(0.0);
    vec2 lobe = vec2(0.0);
    float sum = 0.0;
    for (int y = -halfWidth; y <= halfWidth; ++y)
        for (int x = -halfWidth; x <= halfWidth; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (q.x < 0 || q.y < 0 || q.x > last.x || q.y > last.y || isBackground(q)) continue;
            float w = cellWeight(x, halfWidth) * cellWeight(y, halfWidth) *
                      surfaceWeight(dot(facet, pixelEye(q) - eye) / (1.5 * footprint), dot(n, pixelNormal(q)));
            num += w * texelFetch(numMap, q, 0);
            den += w * texelFetch(denMap, q, 0);
#ifdef HAS_LOBES
            lobe += w * texelFetch(lobeMap, q, 0).rg;
#endif
            sum += w;
        }
#ifdef COMBINE_SUBTRACT
    occlusion.rgb = (den.rgb - num.rgb) / sum * (16.0 * INV_PI);
#else
    occlusion.rgb = vec3(den.r > 0.0 ? num.r / den.r : 1.0, den.g > 0.0 ? num.g / den.g : 1.0,
                         den.b > 0.0 ? num.b / den.b : 1.0);
#endif
    occlusion.a = den.a > 0.0 ? num.a / den.a : 1.0;
#ifdef HAS_LOBES
    lobeSeen = vec4(lobe.g > 0.0 ? lobe.r / lobe.g : 1.0);
#endif
}
