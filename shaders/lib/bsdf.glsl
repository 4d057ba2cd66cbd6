// SPDX-License-Identifier: MIT
// What a surface is made of: a Lambert layer, and above it a lobe of one of the BRDFs. Each pass that shades asks here, so that all
// agree. Local frame as in lib/ggx.glsl. Only the lobes of HAS_PHONG and HAS_COOK_TORRANCE are compiled.
#ifndef BSDF_GLSL
#define BSDF_GLSL

#ifndef __cplusplus  // see glsl.h
#pragma import_defines(HAS_PHONG, HAS_COOK_TORRANCE)
#endif

#include "lib/brdfs.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/phong.glsl"

struct Bsdf {
    int brdf;
    vec3 f0;         // reflectance of the lobe at normal incidence
    float roughness;
    vec3 energy;     // factor of the lobe
    vec3 reflected;  // share of light that the lobe reflects: its directional albedo
    vec3 body;       // share that reaches the Lambert layer
};

// Factor for what a single bounce between microfacets loses: specular.md, 7.
vec3 multipleScattering(vec3 f0, float single)
{
    float e = clamp(single, 0.01, 1.0);
    float p = 1.0 + 1.1 * (1.0 - e) * (1.0 - e);
    return 1.0 + pow(max(f0, vec3(1e-6)), vec3(p)) * (1.0 / e - 1.0);
}

// table: scale and offset of F0 in the Cook-Torrance lobe's directional albedo [pass/albedo.glsl].
Bsdf makeBsdf(int brdf, vec3 f0, float roughness, vec2 table)
{
    Bsdf b;
    b.brdf = brdf;
    b.f0 = f0;
    b.roughness = roughness;
    b.energy = vec3(1.0);
    b.reflected = brdf == BRDF_LAMBERT ? vec3(0.0) : f0;
    b.body = vec3(1.0);
#ifdef HAS_COOK_TORRANCE
    if (brdf == BRDF_COOK_TORRANCE) {
        b.energy = multipleScattering(f0, table.x + table.y);
        b.reflected = (f0 * table.x + table.y) * b.energy;
        b.body = max(1.0 - b.reflected, vec3(0.0));
    }
#endif
    return b;
}

// The lobe's value per solid angle.
vec3 bsdfLobe(Bsdf b, vec3 v, vec3 l)
{
#ifdef HAS_COOK_TORRANCE
    if (b.brdf == BRDF_COOK_TORRANCE)
        return b.energy * fresnelSchlick(b.f0, dot(normalize(v + l), v)) * ggxBrdf(v, l, b.roughness * b.roughness);
#endif
#ifdef HAS_PHONG
    if (b.brdf == BRDF_PHONG) return b.f0 * phongBrdf(vec3(-v.x, -v.y, v.z), l, phongExponent(b.roughness));
#endif
    return vec3(0.0);
}

#endif
