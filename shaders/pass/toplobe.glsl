// SPDX-License-Identifier: MIT
// The lobe in which a pixel is searched for what it shows of the picture: that of its coat, if it has one, or of its surface.
#ifndef TOPLOBE_GLSL
#define TOPLOBE_GLSL

#include "pass/pixelbsdf.glsl"

vec3 topNormal(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) return pixelCoatNormal(p);
#endif
    return pixelNormal(p);
}

int topBrdf(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) return BRDF_COOK_TORRANCE;
#endif
    return pixelBrdf(p);
}

float topRoughness(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) return pixelCoat(p).bsdf.roughness;
#endif
    return texelFetch(normalMap, p, 0).a;
}

vec3 topReflected(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) return pixelCoat(p).bsdf.reflected;
#endif
    return pixelReflected(p);
}

#endif
