// SPDX-License-Identifier: MIT
// The diffuse terms as radiance, read from what their passes left.
#ifndef TERMS_GLSL
#define TERMS_GLSL
#pragma import_defines(HAS_DIFFUSE, HAS_SUNS, HAS_SUN_SHADOWS, HAS_OCCLUSION, COMBINE_SUBTRACT)

#include "pass/hostcolor.glsl"
#include "pass/radiancescale.glsl"

uniform sampler2D diffuseTermMap;
uniform sampler2D sunDiffuseMap;
uniform sampler2D sunShadedMap;
uniform sampler2D occlusionTermMap;
uniform sampler2D emissionMap;  // times 2^baseStops: what is typed as a colour fits half floats under any map

vec3 emitted(ivec2 p)
{
    return texelFetch(emissionMap, p, 0).rgb * exp2(emittedStops);
}

vec3 diffuseTerm(ivec2 p)
{
#ifdef HAS_DIFFUSE
    return texelFetch(diffuseTermMap, p, 0).rgb * radianceScale;
#else
    return vec3(0.0);
#endif
}

vec3 sunDiffuse(ivec2 p)
{
#ifdef HAS_SUNS
    return texelFetch(sunDiffuseMap, p, 0).rgb * radianceScale;
#else
    return vec3(0.0);
#endif
}

// What the scene leaves of it.
vec3 sunShaded(ivec2 p)
{
#ifdef HAS_SUN_SHADOWS
    return texelFetch(sunShadedMap, p, 0).rgb * radianceScale;
#else
    return sunDiffuse(p);
#endif
}

// D - O
vec3 occludedDiffuse(ivec2 p)
{
    vec3 d = diffuseTerm(p);
#ifdef HAS_OCCLUSION
    vec3 o = texelFetch(occlusionTermMap, p, 0).rgb;
#ifdef COMBINE_SUBTRACT
    // Two light lists: the difference may come out below zero, which no radiance is.
    return max(d - pixelAlbedo(p) * o * radianceScale, vec3(0.0));
#else
    return d * o;
#endif
#else
    return d;
#endif
}

// Cosine-weighted share of the whole sphere's directions that the pixel sees.
float ambientVisibility(ivec2 p)
{
#ifdef HAS_OCCLUSION
    return texelFetch(occlusionTermMap, p, 0).a;
#else
    return 1.0;
#endif
}

#endif
