// SPDX-License-Identifier: MIT
// What the environment lights: a surface as it is at a fragment.
#ifndef LITSURFACE_GLSL
#define LITSURFACE_GLSL

#include "lib/brdfs.glsl"
#include "lib/coat.glsl"

struct Surface {
    vec3 albedo;     // of the diffuse layer
    float diffuseRoughness;
    float alpha;     // coverage
    vec3 position;   // eye space
    vec3 ray;        // eye space, unit, away from the eye
    vec3 normal;     // eye space, unit, against the ray
    float roughness; // of the lobe
    vec3 f0;         // colour of the lobe at normal incidence
    vec3 edge;       // of a metal: what is left of Schlick's reflectance towards grazing angles
    int brdf;        // of lib/brdfs.glsl
    vec3 emission;   // radiance
    vec3 baseColor;  // of a coated surface, with its metalness
    float metalness;
    vec3 coatNormal;
    Coat coat;
    float anisotropy; // strength
    vec3 brushed;     // the direction in which highlights are drawn out, of any length, square to the normal
    float bulge;     // of what the normals stand for above the facet, in shares of the distance to the eye: for the suns' maps alone
};

// One that reflects nothing.
Surface blackSurface(vec3 position, vec3 ray, vec3 normal)
{
    Surface s;
    s.albedo = vec3(0.0);
    s.diffuseRoughness = 0.0;
    s.alpha = 1.0;
    s.position = position;
    s.ray = ray;
    s.normal = normal;
    s.roughness = 1.0;
    s.f0 = vec3(0.0);
    s.edge = vec3(1.0);
    s.brdf = BRDF_LAMBERT;
    s.emission = vec3(0.0);
    s.baseColor = vec3(0.0);
    s.metalness = 0.0;
    s.coatNormal = normal;
    s.coat = Coat(0.0, 0.0);
    s.anisotropy = 0.0;
    s.brushed = vec3(0.0);
    s.bulge = 0.0;
    return s;
}

#endif
