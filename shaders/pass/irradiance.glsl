// SPDX-License-Identifier: MIT
// What a surface receives of the map where nothing hides it, by what carries D: spherical harmonics of the map, or the irradiance of
// its importance-sampled lights. In units of the map's mean radiance.
#pragma import_defines(DIFFUSE_SH_9, DIFFUSE_SH_18, DIFFUSE_LIGHTS, HAS_ROUGH_DIFFUSE)

#include "lib/octahedral.glsl"
#include "lib/sh.glsl"
#ifdef HAS_ROUGH_DIFFUSE
#include "lib/roughdiffusesky.glsl"
#endif

#if defined(DIFFUSE_SH_9) || defined(DIFFUSE_SH_18) || defined(HAS_ROUGH_DIFFUSE)
uniform vec3 shCoefficients[18];
#endif
#ifdef DIFFUSE_LIGHTS
uniform sampler2D irradianceMap;  // over pi
#endif

// Over pi, for a normal in the map's frame. Without a carrier there is none.
vec3 irradianceOverPi(vec3 n)
{
#ifdef DIFFUSE_SH_9
    return shIrradiance9(shCoefficients, n);
#elif defined(DIFFUSE_SH_18)
    return shIrradiance(shCoefficients, n);
#elif defined(DIFFUSE_LIGHTS)
    return octahedralLookup(irradianceMap, n);
#else
    return vec3(0.0);
#endif
}
