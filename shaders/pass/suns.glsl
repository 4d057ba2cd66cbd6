// SPDX-License-Identifier: MIT
// The suns that were cut from the map: discs of even radiance, in its frame and in units of its mean.
#ifndef SUNS_GLSL
#define SUNS_GLSL
#pragma import_defines(HAS_SUN_SHADOWS, ONE_SUN)

#include "lib/limits.glsl"
#include "lib/sun.glsl"

#ifdef ONE_SUN
const int sunCount = 1;  // so that the loops over suns and the look-ups in their arrays fall away
#else
uniform int sunCount;
#endif
uniform vec3 sunDirection[MOST_SUNS];
uniform vec3 sunRadiance[MOST_SUNS];
uniform float sunRadius[MOST_SUNS];

#ifdef HAS_SUN_SHADOWS
uniform sampler2D sunVisibilityMap0;
uniform sampler2D sunVisibilityMap1;

// Share of sun i that this pixel sees.
float sunVisibility(int i)
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    return i < 4 ? texelFetch(sunVisibilityMap0, p, 0)[i] : texelFetch(sunVisibilityMap1, p, 0)[i - 4];
}
#else
float sunVisibility(int i)
{
    return 1.0;
}
#endif

// Over pi, of sun i, about the normal n in the map's frame.
vec3 sunIrradianceOverPi(int i, vec3 n)
{
    return sunRadiance[i] * discIrradianceOverPi(dot(n, sunDirection[i]), sunRadius[i]);
}

#endif
