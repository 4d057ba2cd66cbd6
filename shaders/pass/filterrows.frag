#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// O, second part: the lights' sums filtered along rows.
#include "pass/sumsfilter.glsl"

layout(location = 0) out uvec4 rowSums;
layout(location = 1) out uvec4 rowPlace;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    rowPlace = texelFetch(placeMap, p, 0);
    LightSums sums = filteredSums(p, ivec2(1, 0), unpackPlace(rowPlace));
    rowSums = packSums(sums);
}
