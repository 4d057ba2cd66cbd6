// SPDX-License-Identifier: MIT
// Directional albedo of the Cook-Torrance lobe, from the table over (roughness, sqrt cos): scale and offset of F0.
#ifndef ALBEDO_GLSL
#define ALBEDO_GLSL

#include "lib/bsdf.glsl"

uniform sampler2D albedoTable;

vec2 lobeAlbedo(float roughness, float cosV)
{
    vec2 n = vec2(textureSize(albedoTable, 0));
    vec2 st = vec2(roughness, sqrt(clamp(cosV, 0.0, 1.0)));
    return textureLod(albedoTable, (st * (n - 1.0) + 0.5) / n, 0.0).rg;
}

// The Bsdf of a surface seen under cosV.
Bsdf bsdfOf(int brdf, vec3 f0, float roughness, float cosV)
{
    vec2 table = vec2(0.0);
#ifdef HAS_COOK_TORRANCE
    if (brdf == BRDF_COOK_TORRANCE) table = lobeAlbedo(roughness, cosV);
#endif
    return makeBsdf(brdf, f0, roughness, table);
}

#endif
