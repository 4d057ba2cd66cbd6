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

// Metals reflect less towards grazing angles than Schlick's form says. The difference is greatest near 82 degrees, and known there; a
// polynomial has it at other angles [Hoffman 2019; Kutz, Hasan, Edmondson 2021]. Beside fresnelExact() that errs by at most .03, where
// Schlick's form errs by up to .2.
const float EDGE_COSINE = 1.0 / 7.0;

float edgeShare(float c)
{
    float x = clamp(1.0 - c, 0.0, 1.0);
    float x3 = x * x * x;
    return clamp(c, 0.0, 1.0) * x3 * x3;
}

// The factor of edgeShare() that Schlick's form is to be less by. edge: the metal's reflectance at EDGE_COSINE over Schlick's, in [0,1].
vec3 edgeLoss(vec3 f0, vec3 edge)
{
    return (1.0 - edge) * fresnelSchlick(f0, EDGE_COSINE) / edgeShare(EDGE_COSINE);
}

// An edge in 13 bits, in steps of 1/15. The bits of what has none are 0.
uint packEdge(vec3 edge)
{
    uvec3 e = uvec3(clamp(edge, 0.0, 1.0) * 15.0 + 0.5);
    return 4096u | e.r << 8 | e.g << 4 | e.b;
}

vec3 unpackEdge(uint bits)
{
    return bits < 4096u ? vec3(1.0) : vec3(uvec3(bits >> 8, bits >> 4, bits) & 15u) / 15.0;
}

// Fresnel's equations: the share of unpolarised light that a smooth surface in air reflects at the cosine c. Its index of refraction is
// eta + i kappa; kappa of a dielectric is 0 [Born, Wolf 1999, 14.2; pbrt-v4, 9.3.6].
float fresnelExact(float c, float eta, float kappa)
{
    float c2 = c * c;
    float s2 = 1.0 - c2;
    float d = eta * eta - kappa * kappa - s2;
    float sum = sqrt(d * d + 4.0 * eta * eta * kappa * kappa);  // a^2 + b^2
    float a = sqrt(max(0.5 * (sum + d), 0.0));
    float across = (sum + c2 - 2.0 * a * c) / (sum + c2 + 2.0 * a * c);
    float along = (c2 * sum + s2 * s2 - 2.0 * a * c * s2) / (c2 * sum + s2 * s2 + 2.0 * a * c * s2);
    return 0.5 * across * (1.0 + along);
}

#endif
