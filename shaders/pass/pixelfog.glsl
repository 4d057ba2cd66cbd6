// SPDX-License-Identifier: MIT
// The fog before the surface in a pixel.
#ifndef PIXELFOG_GLSL
#define PIXELFOG_GLSL
#pragma import_defines(HAS_FOG)

#include "pass/gbuffer.glsl"
#ifdef HAS_FOG
#include "pass/fog.glsl"

// What the fog leaves of the surface's light; 1 where the application's state has none.
float pixelFogLeaves(sampler2D emissions, ivec2 p)
{
    return texelFetch(emissions, p, 0).a < 0.0 ? fogLeaves(pixelEye(p)) : 1.0;
}
#endif

vec3 throughFog(sampler2D emissions, ivec2 p, vec3 radiance)
{
#ifdef HAS_FOG
    return mix(fogRadiance, radiance, pixelFogLeaves(emissions, p));
#else
    return radiance;
#endif
}

#endif
