// SPDX-License-Identifier: MIT
// Fresnel reflectance.
#ifndef FRESNEL_GLSL
#define FRESNEL_GLSL

const float DIELECTRIC_F0 = 0.04;  // of glass, with an index of refraction of 1.5

// Reflectance at grazing incidence by that at normal incidence: 1. But no substance reflects less than 2 %: a smaller f0 is that of a
// surface whose highlights are turned down, and with it the reflectance at every angle [Lagarde, de Rousiers 2014, 4.2].
float fresnelGrazing(vec3 f0)
{
    return clamp(50.0 * max(f0.x, max(f0.y, f0.z)), 0.0, 1.0);
}

// How far the reflectance has gone from normal incidence to grazing, at cosine c of the half angle [Schlick 1994].
float fresnelShare(float c)
{
    float x = clamp(1.0 - c, 0.0, 1.0);
    float x2 = x * x;
    return x2 * x2 * x;
}

// Reflectance at cosine c of the half angle, f0 at normal incidence.
vec3 fresnelSchlick(vec3 f0, float c)
{
    return f0 + (fresnelGrazing(f0) - f0) * fresnelShare(c);
}

#endif
