// SPDX-License-Identifier: MIT
// Lights of OpenGL's fixed function, shaded by physical BRDFs. A light of colour L, unattenuated, gives a white Lambert surface
// the radiance L cos, as OpenGL does: its irradiance is pi L cos. Local frame as in lib/ggx.glsl.
#ifndef SCENELIGHT_GLSL
#define SCENELIGHT_GLSL

#include "lib/bsdf.glsl"
#include "lib/constants.glsl"

// k: constant, linear, quadratic.
float lightAttenuation(vec3 k, float distance)
{
    return 1.0 / max(k.x + distance * (k.y + distance * k.z), 1e-6);
}

// cosine: of the direction from the light to the axis of its cone.
float lightCone(float cosine, float cosCutoff, float exponent)
{
    if (cosine < cosCutoff) return 0.0;
    return exponent > 0.0 ? pow(max(cosine, 0.0), exponent) : 1.0;
}

// These lights have no size: in a smooth surface their highlight would be a point without area and without bound, which
// pixels hit or miss. Lobes are taken to be as wide as if the light were about two degrees across.
float lightRoughness(float roughness)
{
    return max(roughness, 0.18);
}

// Radiance sent towards v from light of colour 1 in direction l: by the diffuse layer, of pi times its BRDF, and by the lobe.
vec3 lightLambert(vec3 albedo, vec3 l)
{
    return albedo * max(l.z, 0.0);
}

vec3 lightLobe(Bsdf b, vec3 v, vec3 l)
{
    b.roughness = lightRoughness(b.roughness);
    return bsdfLobe(b, v, l) * (PI * max(l.z, 0.0));
}

#endif
