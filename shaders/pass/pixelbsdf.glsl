// SPDX-License-Identifier: MIT
// What the surface in a pixel of the G-buffer is made of.
#ifndef PIXELBSDF_GLSL
#define PIXELBSDF_GLSL

#include "pass/albedo.glsl"
#include "pass/gbuffer.glsl"
#ifdef HAS_COATS
#include "lib/coat.glsl"

// The lobe of a coat, in a frame about its own normal: bumps of what lies below are not its own.
struct PixelCoat {
    vec3 normal;
    mat3 eyeFromLocal;
    vec3 view;  // local
    Bsdf bsdf;
};

PixelCoat pixelCoat(ivec2 p)
{
    PixelCoat c;
    c.normal = pixelCoatNormal(p);
    c.eyeFromLocal = frameAround(c.normal);
    c.view = pixelView(p, c.eyeFromLocal);
    Coat coat = unpackCoat(kindParameters(pixelKind(p)));
    c.bsdf = coatBsdf(coat, lobeAlbedo(BRDF_COOK_TORRANCE, coat.roughness, c.view.z));
    return c;
}
#endif

// Unit vector to the eye in the frame of the pixel's lobe. Where no lobe has a direction of its own, only its height counts.
vec3 lobeView(ivec2 p, vec3 n)
{
#ifdef HAS_ANISOTROPY
    return pixelView(p, pixelFrame(p, n));
#else
    return vec3(0.0, 0.0, max(-dot(n, viewRay(inverseProjection, pixelNdc(p))), 1e-4));
#endif
}

// Seen from v, in its frame; below its coat, if it has one.
Bsdf pixelBsdf(ivec2 p, vec3 v)
{
    float roughness = texelFetch(normalMap, p, 0).a;
#ifdef HAS_ANISOTROPY
    float anisotropy = pixelAnisotropy(p).strength;
    if (anisotropy > 0.0) return anisotropicBsdfOf(pixelF0(p), roughness, anisotropy, v);
#endif
    Bsdf b = bsdfOf(pixelBrdf(p), pixelF0(p), roughness, v.z);
#ifdef HAS_EDGES
    b = withEdge(b, pixelEdge(p), v.z);
#endif
#ifdef HAS_COATS
    if (isCoated(p)) b = belowCoat(b, pixelCoat(p).bsdf.reflected);
#endif
    return b;
}

// The directional albedo of a pixel's lobe, of what is below the coat.
vec3 pixelReflected(ivec2 p)
{
    return pixelBsdf(p, lobeView(p, pixelNormal(p))).reflected;
}

#endif
