// SPDX-License-Identifier: MIT
// A lobe's directional albedo for one bounce, as scale and offset of F0. A table over (roughness, sqrt cos) has that of microfacets, with
// one block for each distribution. Its third number is the factor of edgeLoss() [lib/fresnel.glsl]. Where surfaces are brushed, further
// blocks have all three for GGX by the roughness across the view, over (roughness along the view, sqrt cos).
#ifndef ALBEDO_GLSL
#define ALBEDO_GLSL

#include "lib/bsdf.glsl"
#include "lib/limits.glsl"

uniform sampler2D albedoTable;

vec3 albedoInBlock(float block, float roughness, float cosV)
{
    vec2 size = vec2(textureSize(albedoTable, 0));
    vec2 st = vec2(roughness, sqrt(clamp(cosV, 0.0, 1.0))) * (size.y - 1.0) + 0.5;
    st.x += size.y * block;
    return textureLod(albedoTable, st / size, 0.0).rgb;
}

vec2 lobeAlbedo(int brdf, float roughness, float cosV)
{
#ifdef HAS_STRAUSS
    if (brdf == BRDF_STRAUSS) return straussReflectance(straussSmoothness(phongExponent(roughness)), cosV, cosV);
#endif
#ifdef HAS_MICROFACETS
    if (isMicrofacets(brdf)) {
        return vec2(albedoInBlock(float(albedoBlock(brdf)), roughness, cosV));
    }
#endif
    return vec2(0.0);
}

// The Bsdf of a surface seen under cosV.
Bsdf bsdfOf(int brdf, vec3 f0, float roughness, float cosV)
{
    Bsdf b = makeBsdf(brdf, f0, roughness, lobeAlbedo(brdf, roughness, cosV));
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (isMirrored(brdf)) b.reflected *= phongAlbedo(phongExponent(roughness), cosV);
#endif
    return b;
}

#ifdef HAS_EDGES
// The Bsdf with the edge of its metal; an edge of 1 changes nothing.
Bsdf withEdge(Bsdf b, vec3 edge, float cosV)
{
    if (min(edge.r, min(edge.g, edge.b)) >= 1.0) return b;
    return withEdgeLoss(b, edgeLoss(b.f0, edge), albedoInBlock(float(albedoBlock(b.brdf)), b.roughness, cosV).b);
}
#endif

#ifdef HAS_ANISOTROPY
// The same of a brushed one, seen from v in its frame.
Bsdf anisotropicBsdfOf(vec3 f0, float roughness, float anisotropy, vec3 v)
{
    vec2 about = anisotropicRoughness(anisotropicAlpha(roughness * roughness, anisotropy), v);
    float block = about.y * float(ANISOTROPY_BLOCKS - 1);
    float below = min(floor(block), float(ANISOTROPY_BLOCKS - 2));
    vec3 table = mix(albedoInBlock(float(ALBEDO_BLOCKS) + below, about.x, v.z),
                     albedoInBlock(float(ALBEDO_BLOCKS) + below + 1.0, about.x, v.z), block - below);
    Bsdf b = makeBsdf(BRDF_COOK_TORRANCE, f0, roughness, vec2(table));
    b.anisotropy = anisotropy;
    return b;
}
#endif

#endif
