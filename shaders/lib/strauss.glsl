// SPDX-License-Identifier: MIT
// Strauss's model of smoothness and metalness ["A Realistic Lighting Model for Computer Animators", 1990], its highlight normalised as
// a Phong lobe is. Of a smoothness s in [0,1] the lobe is cos^n about the mirror direction, n = 3 / (1 - s) up to 1e6. As printed the
// model is not reciprocal: its Fresnel term is of the light's angle alone.
#ifndef STRAUSS_GLSL
#define STRAUSS_GLSL

#include "lib/constants.glsl"

float straussExponent(float smoothness)
{
    return 3.0 / max(1.0 - smoothness, 3e-6);
}

float straussSmoothness(float exponent)
{
    return clamp(1.0 - 3.0 / max(exponent, 3.0), 0.0, 1.0);
}

// Share of light that the Lambert layer reflects, times colour; smooth metals have none.
float straussDiffuse(float smoothness, float metalness)
{
    return (1.0 - metalness * smoothness) * (1.0 - smoothness * smoothness * smoothness);
}

// Fresnel's rise towards grazing light, 0..1, by its angle in right angles.
float straussFresnel(float x)
{
    const float k = 1.12;
    float none = 1.0 / (k * k);
    return (1.0 / ((x - k) * (x - k)) - none) / (1.0 / ((1.0 - k) * (1.0 - k)) - none);
}

// Shadowing, 1 at the normal, 0 at grazing.
float straussShadow(float x)
{
    const float k = 1.01;
    float grazing = 1.0 / ((1.0 - k) * (1.0 - k));
    return (grazing - 1.0 / ((x - k) * (x - k))) / (grazing - 1.0 / (k * k));
}

// Reflectance of the lobe as scale and offset of its colour at normal incidence; cosines to eye and light.
vec2 straussReflectance(float smoothness, float cosV, float cosL)
{
    float light = acos(clamp(cosL, 0.0, 1.0)) / (0.5 * PI);
    float eye = acos(clamp(cosV, 0.0, 1.0)) / (0.5 * PI);
    float fresnel = straussFresnel(light);
    float normal = smoothness * smoothness * smoothness;
    float adjusted = min(normal + (normal + 0.1) * fresnel * straussShadow(light) * straussShadow(eye), 1.0);
    return adjusted * vec2(1.0 - fresnel, fresnel);
}

#endif
