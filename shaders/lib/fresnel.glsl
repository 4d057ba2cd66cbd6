// SPDX-License-Identifier: MIT
// Fresnel reflectance.
#ifndef FRESNEL_GLSL
#define FRESNEL_GLSL

// Schlick 1994: reflectance at cosine c of the half angle, f0 at normal incidence, 1 at grazing.
vec3 fresnelSchlick(vec3 f0, float c)
{
    float x = clamp(1.0 - c, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}

#endif
