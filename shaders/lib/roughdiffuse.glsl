// SPDX-License-Identifier: MIT
// A rough diffuse layer: facets, each a Lambert surface, that shade and light each other [Oren, Nayar 1994]. One bounce has Fujii's form;
// further bounces give back what it loses [Portsmouth, Kutz, Hill 2025]. Roughness 0 is a Lambert surface. White reflects everything.
#ifndef ROUGHDIFFUSE_GLSL
#define ROUGHDIFFUSE_GLSL

#include "lib/constants.glsl"

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

// The roughness in 8 bits of a kind's parameters. The bit above them marks a metal's edge. The host's own programs may leave anything
// in the four below.
uint packDiffuseRoughness(float roughness)
{
    return uint(clamp(roughness, 0.0, 1.0) * 255.0 + 0.5) << 4;
}

float unpackDiffuseRoughness(uint bits)
{
    return bits < 4096u ? float(bits >> 4) / 255.0 : 0.0;
}

// Four integrals over the cosine x of the light, from 0 to 1: of x sqrt(1 - x^2) f(x) / max(x, c) for f = 1, x, x^2 and 1 - x^2. c is
// the cosine of the view.
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

#endif
