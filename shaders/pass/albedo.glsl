// SPDX-License-Identifier: MIT
// A lobe's directional albedo for one bounce, as scale and offset of F0. A table over (roughness, sqrt cos) has that of microfacets, with
// one block for each distribution.
#ifndef ALBEDO_GLSL
#define ALBEDO_GLSL

#include "lib/bsdf.glsl"

uniform sampler2D albedoTable;

vec2 lobeAlbedo(int brdf, float roughness, float cosV)
{
#ifdef HAS_STRAUSS
    if (brdf == BRDF_STRAUSS) return straussReflectance(straussSmoothness(phongExponent(roughness)), cosV, cosV);
#endif
#ifdef HAS_MICROFACETS
    if (isMicrofacets(brdf)) {
        vec2 size = vec2(textureSize(albedoTable, 0));
        vec2 st = vec2(roughness, sqrt(clamp(cosV, 0.0, 1.0))) * (size.y - 1.0) + 0.5;
        st.x += size.y * float(albedoBlock(brdf));
        return textureLod(albedoTable, st / size, 0.0).rg;
    }
#endif
    return vec2(0.0);
}

// The Bsdf of a surface seen under cosV.
Bsdf bsdfOf(int brdf, vec3 f0, float roughness, float cosV)
{
    return makeBsdf(brdf, f0, roughness, lobeAlbedo(brdf, roughness, cosV));
}

#endif
