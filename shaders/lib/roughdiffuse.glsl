// SPDX-License-Identifier: MIT
// The diffuse layer of a surface: facets that are Lambert's, and what goes on between them [Oren, Nayar 1994], in Fujii's form with
// several bounces [Portsmouth, Kutz, Hill 2025]. At roughness 0 it is Lambert's, and a white one loses nothing at any roughness.
#ifndef ROUGHDIFFUSE_GLSL
#define ROUGHDIFFUSE_GLSL

#include "lib/constants.glsl"
#include "lib/sh.glsl"

struct RoughDiffuse {
    float roughness;
    vec3 once;    // what one bounce has of every direction
    vec3 between; // the factor of further bounces
};

// What a white surface loses in all directions to its facets' shadows, per roughness; and the part of it that comes back of one
// bounce on average.
const float FACETS_LOSS = 0.287793409210806;    // 1/2 - 2 / (3 pi)
const float FACETS_RETURN = 0.0724882124569239; // 2/3 - 28 / (15 pi)

RoughDiffuse roughDiffuse(vec3 albedo, float roughness)
{
    float scale = 1.0 / (1.0 + FACETS_LOSS * roughness);
    float mean = scale * (1.0 + FACETS_RETURN * roughness);
    RoughDiffuse d;
    d.roughness = roughness;
    d.once = albedo * scale;
    d.between = albedo * albedo * (mean * scale * roughness / (FACETS_LOSS - FACETS_RETURN)) / (1.0 - albedo * (1.0 - mean));
    return d;
}

// The diffuse layer's 8 bits of roughness among a kind's parameters: below those of metals' edges, above what programs of the host's
// own may leave in the lowest four.
uint packDiffuseRoughness(float roughness)
{
    return uint(clamp(roughness, 0.0, 1.0) * 255.0 + 0.5) << 4;
}

float unpackDiffuseRoughness(uint bits)
{
    return bits < 4096u ? float(bits >> 4) / 255.0 : 0.0;
}

// Integrals over x = cos(theta) of the light, of x sin(theta) f(x) / max(x, c): of 1, x and x^2, and sin^2. c: cosine to the view.
vec4 facetIntegrals(float c)
{
    float s2 = max(1.0 - c * c, 0.0);
    float s = sqrt(s2);
    float s3 = s * s2;
    float rise = atan(c, s);  // of the view above the surface
    float quarter = 0.125 * (rise - c * s * (1.0 - 2.0 * c * c));  // of x^2 sqrt(1 - x^2), from 0 to c
    // (1 - s^n) / c without the difference
    float lower = c / (1.0 + s) / 3.0 * (1.0 + s + s2);
    float lower2 = c / (1.0 + s) / 15.0 * (2.0 * (1.0 + s + s2) - 3.0 * s3 * (1.0 + s));
    float lower4 = c / (1.0 + s) / 5.0 * (1.0 + s + s2 + s3 + s2 * s2);
    return vec4(lower + 0.5 * (0.5 * PI - rise - s * c),
                quarter / max(c, 1e-6) + s3 / 3.0,
                lower2 + 0.0625 * PI - quarter,
                lower4 + 0.1875 * PI - 0.125 * c * s * (5.0 - 2.0 * c * c) - 0.375 * rise);
}

// What one bounce returns beside Lambert's, per roughness, of light from everywhere.
float facetReturn(float c)
{
    return 2.0 / PI * sqrt(max(1.0 - c * c, 0.0)) * (facetIntegrals(c).x - 1.0 / 3.0);
}

// pi times the BRDF. cosV, cosL: of the view and the light to the normal; between: of the angle from one to the other.
vec3 roughDiffuseBrdf(RoughDiffuse d, float cosV, float cosL, float between)
{
    float s = between - cosV * cosL;
    float shape = s > 0.0 ? s / max(max(cosV, cosL), 1e-4) : s;
    float further = (FACETS_LOSS - facetReturn(cosV)) * (FACETS_LOSS - facetReturn(cosL));
    return d.once * (1.0 + d.roughness * shape) + d.between * further;
}

// Its directional albedo.
vec3 roughDiffuseAlbedo(RoughDiffuse d, float cosV)
{
    float r = facetReturn(cosV);
    return d.once * (1.0 + d.roughness * r) + d.between * (FACETS_LOSS - r) * (FACETS_LOSS - FACETS_RETURN);
}

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
