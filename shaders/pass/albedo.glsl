// SPDX-License-Identifier: MIT
// Directional albedo of the Cook-Torrance lobe, from the table over (roughness, sqrt cos): scale and offset of F0.
#ifndef ALBEDO_GLSL
#define ALBEDO_GLSL

uniform sampler2D albedoTable;

vec2 lobeAlbedo(float roughness, float cosV)
{
    vec2 n = vec2(textureSize(albedoTable, 0));
    vec2 st = vec2(roughness, sqrt(clamp(cosV, 0.0, 1.0)));
    return textureLod(albedoTable, (st * (n - 1.0) + 0.5) / n, 0.0).rg;
}

// Factor for what a single bounce between microfacets loses: specular.md, 7.
vec3 multipleScattering(vec3 f0, float single)
{
    float e = clamp(single, 0.01, 1.0);
    float p = 1.0 + 1.1 * (1.0 - e) * (1.0 - e);
    return 1.0 + pow(max(f0, vec3(1e-6)), vec3(p)) * (1.0 / e - 1.0);
}

#endif
