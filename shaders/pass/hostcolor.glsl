// SPDX-License-Identifier: MIT
// Colours that the host gives as numbers: of materials, vertices and lights.
#ifndef HOSTCOLOR_GLSL
#define HOSTCOLOR_GLSL

#include "lib/tone.glsl"

uniform int materialColors;  // 0: display values, sRGB encoded up to 1
uniform float emittedStops;  // against the map's exposure: what emits is shown as it was typed

vec3 hostColor(vec3 c)
{
    return materialColors == 0 ? typedDecode3(c) : c;
}

// Radiance of an emission of 1 as the host gives it.
float emittedScale()
{
    return materialColors == 0 ? exp2(emittedStops) : 1.0;
}

// Radiance that such a colour stands for.
vec3 hostRadiance(vec3 c)
{
    return hostColor(c) * emittedScale();
}

#endif
