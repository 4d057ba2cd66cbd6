// SPDX-License-Identifier: MIT
// Pixels that show the surface of an area light: what that sends to others is in the light's own terms.
#ifndef PASS_LIGHTMARK_GLSL
#define PASS_LIGHTMARK_GLSL

#include "lib/limits.glsl"

bool isAreaLight(sampler2D emissions, ivec2 p)
{
    return abs(abs(texelFetch(emissions, p, 0).a) - LIGHT_MARK) < 0.1;
}

#endif
