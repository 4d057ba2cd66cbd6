// SPDX-License-Identifier: MIT
// What a surface is made of: a Lambert layer, and above it a lobe of one of the BRDFs. Each pass that shades asks here, so that all
// agree. Local frame as in lib/ggx.glsl. Only the lobes that are asked for are compiled: HAS_PHONG, HAS_COOK_TORRANCE,
// HAS_BLINN_PHONG, HAS_BECKMANN, HAS_STRAUSS, HAS_ANISOTROPY, HAS_EDGES, and HAS_COATS of lib/coat.glsl.
#ifndef BSDF_GLSL
#define BSDF_GLSL

#ifndef __cplusplus  // see glsl.h
#pragma import_defines(HAS_PHONG, HAS_COOK_TORRANCE, HAS_BLINN_PHONG, HAS_BECKMANN, HAS_STRAUSS, HAS_ANISOTROPY, HAS_EDGES, HAS_COATS)
#endif
#if defined(HAS_COOK_TORRANCE) || defined(HAS_COATS)
#define HAS_GGX
#endif
#if defined(HAS_GGX) || defined(HAS_BLINN_PHONG) || defined(HAS_BECKMANN)
#define HAS_MICROFACETS
#endif

#include "lib/anisotropy.glsl"
#include "lib/beckmann.glsl"
#include "lib/blinn.glsl"
#include "lib/brdfs.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/phong.glsl"
#include "lib/strauss.glsl"

struct Bsdf {
    int brdf;
    vec3 f0;         // reflectance of the lobe at normal incidence
    float roughness;
#ifdef HAS_ANISOTROPY
    float anisotropy;  // strength, along the local frame's x; of GGX alone
#endif
#ifdef HAS_EDGES
    vec3 edgeLoss;     // of metals [lib/fresnel.glsl]
#endif
    vec3 energy;     // factor of the lobe
    vec3 reflected;  // share of light that the lobe reflects: its directional albedo
    vec3 body;       // share that reaches the Lambert layer
};

// Lobes that normals half-way to the light make.
bool isMicrofacets(int brdf)
{
    return brdf == BRDF_COOK_TORRANCE || brdf == BRDF_BECKMANN || brdf == BRDF_BLINN_PHONG;
}

// Two alphas where GGX's normals are not as rough along the frame's x as along its y.
#ifdef HAS_ANISOTROPY
#define LOBE_ALPHA vec2
#else
#define LOBE_ALPHA float
#endif

LOBE_ALPHA lobeAlpha(Bsdf b)
{
#ifdef HAS_ANISOTROPY
    if (b.anisotropy > 0.0) return anisotropicAlpha(b.roughness * b.roughness, b.anisotropy);
#endif
    return LOBE_ALPHA(b.roughness * b.roughness);
}

// Of the lobe that is as wide in solid angle and the same in all directions.
float evenAlpha(Bsdf b)
{
    vec2 alpha = vec2(lobeAlpha(b));
    return sqrt(alpha.x * alpha.y);
}

float evenRoughness(Bsdf b)
{
#ifdef HAS_ANISOTROPY
    if (b.anisotropy > 0.0) return sqrt(evenAlpha(b));
#endif
    return b.roughness;
}

// Along the direction in which it is widest.
float widestRoughness(Bsdf b)
{
#ifdef HAS_ANISOTROPY
    if (b.anisotropy > 0.0) return sqrt(lobeAlpha(b).x);
#endif
    return b.roughness;
}

// Which block of the albedo table is theirs.
int albedoBlock(int brdf)
{
    return brdf == BRDF_COOK_TORRANCE ? 0 : brdf == BRDF_BECKMANN ? 1 : 2;
}

// Lobes that are a power of the angle to the mirror direction.
bool isMirrored(int brdf)
{
    return brdf == BRDF_PHONG || brdf == BRDF_STRAUSS;
}

// Factor for what a single bounce between microfacets loses: specular.md, 7.
vec3 multipleScattering(vec3 f0, float single)
{
    float e = clamp(single, 0.01, 1.0);
    float p = 1.0 + 1.1 * (1.0 - e) * (1.0 - e);
    return 1.0 + pow(max(f0, vec3(1e-6)), vec3(p)) * (1.0 / e - 1.0);
}

// table: scale and offset of F0 in the lobe's directional albedo, of one bounce [pass/albedo.glsl].
Bsdf makeBsdf(int brdf, vec3 f0, float roughness, vec2 table)
{
    Bsdf b;
    b.brdf = brdf;
    b.f0 = f0;
    b.roughness = roughness;
#ifdef HAS_ANISOTROPY
    b.anisotropy = 0.0;
#endif
#ifdef HAS_EDGES
    b.edgeLoss = vec3(0.0);
#endif
    b.energy = vec3(1.0);
    b.reflected = brdf == BRDF_LAMBERT ? vec3(0.0) : f0;
    b.body = vec3(1.0);
#ifdef HAS_BLINN_PHONG
    // As for Phong, diffuse and specular reflectance sum to 1 at most.
    if (brdf == BRDF_BLINN_PHONG) {
        b.energy = multipleScattering(f0, table.x + table.y);
        b.reflected = f0 * (table.x + table.y) * b.energy;
    }
#endif
#if defined(HAS_GGX) || defined(HAS_BECKMANN)
    if (brdf == BRDF_COOK_TORRANCE || brdf == BRDF_BECKMANN) {
        b.energy = multipleScattering(f0, table.x + table.y);
        b.reflected = (f0 * table.x + fresnelGrazing(f0) * table.y) * b.energy;
        b.body = max(1.0 - b.reflected, vec3(0.0));
    }
#endif
#ifdef HAS_STRAUSS
    if (brdf == BRDF_STRAUSS) {
        b.reflected = f0 * table.x + table.y;
        float s = straussSmoothness(phongExponent(roughness));
        b.body = min((1.0 - b.reflected) / max(1.0 - s * s * s, 1e-5), vec3(1.0));
    }
#endif
    return b;
}

#ifdef HAS_EDGES
// A metal that reflects less towards grazing angles. table: the mean of edgeShare() over the lobe [pass/albedo.glsl].
Bsdf withEdgeLoss(Bsdf b, vec3 loss, float table)
{
    b.edgeLoss = loss;
    b.reflected = max(b.reflected - loss * table * b.energy, vec3(0.0));
    b.body = max(1.0 - b.reflected, vec3(0.0));
    return b;
}
#endif

#ifdef HAS_MICROFACETS
// The share of light that a facet reflects, at the cosine c to its normal.
vec3 bsdfFresnel(Bsdf b, float c)
{
    if (b.brdf == BRDF_BLINN_PHONG) return b.f0;
#ifdef HAS_EDGES
    return max(fresnelSchlick(b.f0, c) - b.edgeLoss * edgeShare(c), vec3(0.0));
#else
    return fresnelSchlick(b.f0, c);
#endif
}

// Masking and shadowing over four cosines.
float bsdfVisibility(Bsdf b, vec3 v, vec3 l)
{
#ifdef HAS_BECKMANN
    if (b.brdf == BRDF_BECKMANN) {
        float alpha = b.roughness * b.roughness;
        return smithVisibility(v.z, beckmannRoot(v.z, alpha), l.z, beckmannRoot(l.z, alpha));
    }
#endif
#ifdef HAS_BLINN_PHONG
    if (b.brdf == BRDF_BLINN_PHONG) {
        float n = phongExponent(b.roughness);
        return smithVisibility(v.z, blinnRoot(v.z, n), l.z, blinnRoot(l.z, n));
    }
#endif
    LOBE_ALPHA alpha = lobeAlpha(b);
    return smithVisibility(v.z, ggxRoot(v, alpha), l.z, ggxRoot(l, alpha));
}

// Density of the facets' normals.
float bsdfNormals(Bsdf b, vec3 h)
{
#ifdef HAS_BECKMANN
    if (b.brdf == BRDF_BECKMANN) return beckmannD(h, b.roughness * b.roughness);
#endif
#ifdef HAS_BLINN_PHONG
    if (b.brdf == BRDF_BLINN_PHONG) return blinnD(h, phongExponent(b.roughness));
#endif
    return ggxD(h, lobeAlpha(b));
}

// The lobe's value without Fresnel, of one bounce; h half-way.
float bsdfMicrofacets(Bsdf b, vec3 v, vec3 l, vec3 h)
{
    return v.z > 0.0 && l.z > 0.0 ? bsdfNormals(b, h) * bsdfVisibility(b, v, l) : 0.0;
}
#endif

#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
// The factor of the power of the angle to the mirror direction.
vec3 bsdfMirrored(Bsdf b, float cosV, float cosL)
{
#ifdef HAS_STRAUSS
    if (b.brdf == BRDF_STRAUSS) {
        vec2 r = straussReflectance(straussSmoothness(phongExponent(b.roughness)), cosV, cosL);
        return b.f0 * r.x + r.y;
    }
#endif
    return b.f0;
}
#endif

// The lobe's value per solid angle.
vec3 bsdfLobe(Bsdf b, vec3 v, vec3 l)
{
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (isMirrored(b.brdf))
        return bsdfMirrored(b, v.z, l.z) * phongBrdf(vec3(-v.x, -v.y, v.z), l, phongExponent(b.roughness));
#endif
#ifdef HAS_MICROFACETS
    if (isMicrofacets(b.brdf)) {
        vec3 h = normalize(v + l);
        return b.energy * bsdfFresnel(b, dot(h, v)) * bsdfMicrofacets(b, v, l, h);
    }
#endif
    return vec3(0.0);
}

#endif
