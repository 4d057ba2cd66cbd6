// SPDX-License-Identifier: MIT
// The BRDF's number in the G-buffer, and its lobe as the maps' lights are weighted by it.
#ifndef BRDF_GLSL
#define BRDF_GLSL

#define BRDF_LAMBERT 0
#define BRDF_PHONG 1
#define BRDF_COOK_TORRANCE 2

// The distribution of normals half-way to the light, unnormalized. Narrower ones than of alpha .3 would hold too few of the
// lights.
float lobeShare(vec3 normal, vec3 view, vec3 light, float roughness)
{
    float alpha = max(roughness * roughness, 0.3);
    float c = dot(normal, normalize(view + light));
    float t = c * c * (alpha * alpha - 1.0) + 1.0;
    return 1.0 / (t * t);
}

#endif
