// SPDX-License-Identifier: MIT
// What the surface in a pixel of the G-buffer is made of.
#ifndef PIXELBSDF_GLSL
#define PIXELBSDF_GLSL

#include "lib/frame.glsl"
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
    uint kind = pixelKind(p);
    Coat coat = unpackCoat(kind >> 11 << 8 | kind & 255u);
    c.bsdf = coatBsdf(coat, lobeAlbedo(BRDF_COOK_TORRANCE, coat.roughness, c.view.z));
    return c;
}
#endif

// Seen under cosV; below its coat, if it has one.
Bsdf pixelBsdf(ivec2 p, float cosV)
{
    Bsdf b = bsdfOf(pixelBrdf(p), pixelF0(p), texelFetch(normalMap, p, 0).a, cosV);
#ifdef HAS_COATS
    if (isCoated(p)) b = belowCoat(b, pixelCoat(p).bsdf.reflected);
#endif
    return b;
}

// The directional albedo of a pixel's lobe, of what is below the coat.
vec3 pixelReflected(ivec2 p)
{
    float cosV = max(-dot(pixelNormal(p), viewRay(inverseProjection, pixelNdc(p))), 1e-4);
    return pixelBsdf(p, cosV).reflected;
}

#endif
