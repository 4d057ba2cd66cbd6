#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// S of clear coats. Their lobes are narrow: each pixel takes all samples of its own, and asks the map's lights near its lobe what the
// scene leaves of it; nothing is averaged over cells.
#pragma import_defines(HAS_SUNS, HAS_LOBE_LIGHTS, MAP_IS_BLACK)

#include "pass/lobesamples.glsl"
#include "pass/pixelbsdf.glsl"
#ifdef HAS_LOBE_LIGHTS
#include "pass/lobelights.glsl"
#endif

layout(location = 0) out vec4 coatTerm;
#ifdef HAS_LOBE_LIGHTS
layout(location = 1) out vec4 blockedCoat;  // as for other lobes: pass/lobes.frag
#endif

#ifdef HAS_COATS
LobePixel lobePixel(PixelCoat c)
{
    LobePixel l;
    l.bsdf = c.bsdf;
    l.alpha = evenAlpha(c.bsdf);
    l.samples = specularSamples;
    l.view = c.view;
    l.mapFromLocal = mapFromEye * c.eyeFromLocal;
    l.group = 0.0;
    l.companions = 1.0;
    return l;
}

#if defined(HAS_LOBE_LIGHTS) && defined(HAS_ATLAS)
// The lights near a wider lobe are not all that it is made of.
const float MOST_LIT_ROUGHNESS = 0.5;

LobeSeen coatSeen(ivec2 p, PixelCoat c)
{
    Bsdf bsdf = c.bsdf;
    bsdf.roughness = clamp(bsdf.roughness, LEAST_LIT_ROUGHNESS, MOST_LIT_ROUGHNESS);
    mat3 lightsFromEye = mat3(atlasFromEye);
    PixelLobe lobe = withNearLights(pixelLobe(lightsFromEye * c.eyeFromLocal, c.view, bsdf), 0);
    LobeLights sums = LobeLights(vec3(0.0), vec3(0.0), vec2(0.0));
    vec3 eye = pixelEye(p);
    vec3 facet = lightsFromEye * pixelFacet(p, eye, pixelNormal(p));
    addNearLights(lobe, vec3(atlasFromEye * vec4(eye, 1.0)), lightsFromEye * c.normal, facet, sums);
    return lobeSeen(sums);
}
#endif
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    coatTerm = vec4(0.0);
#ifdef HAS_LOBE_LIGHTS
    blockedCoat = vec4(0.0);
#endif
#ifdef HAS_COATS
    PixelCoat c = pixelCoat(p);
    vec3 shown = vec3(1.0);
#if defined(HAS_LOBE_LIGHTS) && defined(HAS_ATLAS)
    LobeSeen seen = coatSeen(p, c);
    shown = seen.light;
    blockedCoat = (1.0 - seen.sky) * vec4(c.bsdf.reflected, 1.0);
#endif
#ifndef MAP_IS_BLACK
    LobePixel l = lobePixel(c);
    vec4 estimate = sampled(l);
    coatTerm.rgb = shown * estimate.rgb / max(estimate.a, 1e-6);
#ifdef HAS_SUNS
    coatTerm.rgb += glint(l);
#endif
#endif
#endif
}
