// SPDX-License-Identifier: MIT
// A clear coat: a thin layer of lacquer over a surface, microfacets of GGX with the reflectance of glass. It reflects a share of the
// light, and what lies below gets the rest [OpenPBR 1.1, 3.8; KHR_materials_clearcoat].
#ifndef COAT_GLSL
#define COAT_GLSL

#include "lib/bsdf.glsl"

struct Coat {
    float strength;   // 0: none, 1: all of the surface
    float roughness;
};

// As 13 bits: strength in steps of 1/31, roughness in steps of 1/255.
uint packCoat(Coat c)
{
    uint strength = uint(clamp(c.strength, 0.0, 1.0) * 31.0 + 0.5);
    uint roughness = uint(clamp(c.roughness, 0.0, 1.0) * 255.0 + 0.5);
    return strength * 256u + roughness;
}

Coat unpackCoat(uint bits)
{
    Coat c;
    c.strength = float(bits / 256u) / 31.0;
    c.roughness = float(bits % 256u) / 255.0;
    return c;
}

#ifdef HAS_MICROFACETS
// The coat's own lobe; table: of GGX, as for makeBsdf().
Bsdf coatBsdf(Coat c, vec2 table)
{
    Bsdf b = makeBsdf(BRDF_COOK_TORRANCE, vec3(DIELECTRIC_F0), c.roughness, table);
    b.energy *= c.strength;
    b.reflected *= c.strength;
    return b;
}

// A surface below a coat that reflects that share of the light.
Bsdf belowCoat(Bsdf b, vec3 reflected)
{
    vec3 through = max(1.0 - reflected, vec3(0.0));
    b.energy *= through;
    b.reflected *= through;
    b.body *= through;
    return b;
}
#endif

#endif
