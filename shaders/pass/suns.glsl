// SPDX-License-Identifier: MIT
// The suns that were cut from the map: discs of even radiance, in its frame and in units of its mean. They cast no shadows.
#ifndef SUNS_GLSL
#define SUNS_GLSL

#include "lib/sun.glsl"

uniform int sunCount;
uniform vec3 sunDirection[8];
uniform vec3 sunRadiance[8];
uniform float sunRadius[8];

// About the normal n, in the map's frame.
vec3 sunIrradianceOverPi(vec3 n)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < sunCount; ++i) sum += sunRadiance[i] * discIrradianceOverPi(dot(n, sunDirection[i]), sunRadius[i]);
    return sum;
}

#endif
