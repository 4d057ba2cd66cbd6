// SPDX-License-Identifier: MIT
// The cheap form of S, the split sum [Karis 2013]: the map filtered beforehand by lobes of GGX that are seen from straight above, one
// width a level of an octahedral pyramid, times the directional albedo.
#ifndef PREFILTERED_GLSL
#define PREFILTERED_GLSL

#include "lib/constants.glsl"

// A level's alpha is that of a lobe which holds half of its energy within some four texels: the last, of 4 x 4 texels, has 1.
const float PREFILTERED_WIDTH = 4.0;

float prefilteredAlpha(float baseSide, float level)
{
    return PREFILTERED_WIDTH * exp2(level) / baseSide;
}

// Below the first level's alpha it is negative: a share of the map itself is due.
float prefilteredLevel(float baseSide, float alpha)
{
    return log2(max(alpha, 1e-6) * baseSide / PREFILTERED_WIDTH);
}

// Where the middle of a lobe about the mirror direction of v lies, in the local frame: rough lobes lean to the normal, for what lies
// flat is masked [Lagarde, de Rousiers 2014, 4.9.3].
vec3 dominantDirection(vec3 v, float alpha)
{
    float smoothness = 1.0 - alpha;
    float mirrored = smoothness * (sqrt(smoothness) + alpha);
    return normalize(mix(vec3(0.0, 0.0, 1.0), vec3(-v.x, -v.y, v.z), mirrored));
}

#endif
