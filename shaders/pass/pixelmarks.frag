#version 330 compatibility
// SPDX-License-Identifier: MIT
// Marks for the depth test of the passes after this one: does a pixel show a surface, has that a lobe, a narrow one, a coat?
#pragma import_defines(HAS_LOBES)

#include "lib/limits.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lobewidth.glsl"

#ifdef HAS_LOBES
// Of the pixel's lobe, along the direction in which it is widest.
float widestRoughness(ivec2 p)
{
    float roughness = texelFetch(normalMap, p, 0).a;
#ifdef HAS_ANISOTROPY
    float strength = pixelAnisotropy(p).strength;
    if (strength > 0.0) roughness = sqrt(anisotropicAlpha(roughness * roughness, strength).x);
#endif
    return roughness;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    float mark = MARK_SURFACE;
#ifdef HAS_LOBES
    if (pixelBrdf(p) != BRDF_LAMBERT) mark = widestRoughness(p) < TRACED_ROUGHNESS ? MARK_TRACED : MARK_GLOSSY;
#ifdef HAS_COATS
    if (isCoated(p)) mark = MARK_COATED;
#endif
#endif
    gl_FragDepth = isBackground(p) ? MARK_NONE : mark;
}
