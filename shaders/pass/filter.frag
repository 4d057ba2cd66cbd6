#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// O, last part: the rows' sums, filtered along columns. Only then num is divided by den (systems.md E3). With COMBINE_SUBTRACT the
// result is the occluded irradiance over pi, as printed in seed 000. With COMBINE_SUM it is the mean of den.
#pragma import_defines(COMBINE_SUBTRACT, COMBINE_SUM)

#include "lib/constants.glsl"
#include "pass/sumsfilter.glsl"

layout(location = 0) out vec4 occlusion;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    SumsPlace place = unpackPlace(texelFetch(placeMap, p, 0));
    LightSums sums = filteredSums(p, ivec2(0, 1), place);
    vec4 num = sums.num;
    vec4 den = sums.den;
#if defined(COMBINE_SUM)
    occlusion = den;
    return;
#elif defined(COMBINE_SUBTRACT)
    occlusion.rgb = (den.rgb - num.rgb) * (16.0 * INV_PI);
#else
    occlusion.rgb = vec3(den.r > 0.0 ? num.r / den.r : 1.0, den.g > 0.0 ? num.g / den.g : 1.0,
                         den.b > 0.0 ? num.b / den.b : 1.0);
#endif
    occlusion.a = den.a > 0.0 ? num.a / den.a : 1.0;
}
