// SPDX-License-Identifier: MIT
// The rough diffuse layer under a sky that spherical harmonics describe.
#ifndef ROUGHDIFFUSESKY_GLSL
#define ROUGHDIFFUSESKY_GLSL

#include "lib/constants.glsl"
#include "lib/roughdiffuse.glsl"
#include "lib/sh.glsl"

// What it sends towards the unit direction v of a sky whose irradiance over pi about the normal n is known exactly, and whose
// differences between directions bands 0 to 2 of c have, as in shIrradiance().
vec3 roughDiffuseOfSky(RoughDiffuse d, vec3 n, vec3 v, vec3 irradiance, vec3 c[18])
{
    float cosV = clamp(dot(n, v), 0.0, 1.0);
    vec3 across = v - dot(n, v) * n;
    float sinV = length(across);
    vec3 x = across / max(sinV, 1e-4);
    vec3 mean = c[0] * shBasis18(0, n);
    vec3 rise = shRadiance1(c, n);
    vec3 bandN = shRadiance2(c, n);
    vec3 bandX = shRadiance2(c, x);
    vec3 bandXN = 2.0 * shRadiance2(c, 0.70710678118654752 * (x + n)) - bandX - bandN;  // twice the form's mixed term
    vec4 f = facetIntegrals(cosV);
    float ofMean = 2.0 / PI * (f.x - 1.0 / 3.0);
    float ofNN = 2.0 / PI * (f.z - 2.0 / 15.0);
    float ofXX = 4.0 / (3.0 * PI) * (f.w - 0.2);
    float c2 = cosV * cosV;
    vec3 shape = mean * ofMean + rise * (2.0 / PI * (f.y - 0.0625 * PI)) +
                 shRadiance1(c, x) * (0.5 * (11.0 / 12.0 - 0.5 * cosV + cosV * c2 / 12.0)) +
                 bandN * ofNN + bandX * ofXX - (bandN + bandX) * (ofMean - ofNN - ofXX) +
                 bandXN * (0.5 * (0.25 - c2 / 6.0 + 0.05 * c2 * c2 + 2.0 / 15.0));
    vec3 once = max(irradiance + d.roughness * sinV * shape, vec3(0.0));
    // Of further bounces: irradiance less the facets' return about the normal, in bands.
    vec3 further = max(FACETS_LOSS * irradiance - (FACETS_RETURN * mean + 0.0325253196571163 * rise - 0.00954594242355684 * bandN),
                       vec3(0.0));
    return d.once * once + d.between * (FACETS_LOSS - sinV * ofMean) * further;
}

#endif
