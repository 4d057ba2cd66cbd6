#version 330 compatibility
// SPDX-License-Identifier: MIT
// D: the diffuse term without occlusion, rho/pi times the integral of L cos [seed 000, eq. 3, second term].
// Radiance in units of the map's mean.
#pragma import_defines(HAS_SUNS, HAS_SUN_SHADOWS)

#include "lib/constants.glsl"
#include "pass/gbuffer.glsl"
#include "pass/pixelbsdf.glsl"
#include "pass/irradiance.glsl"
#ifdef HAS_SUNS
#include "pass/suns.glsl"
#endif

layout(location = 0) out vec4 diffuse;
#ifdef HAS_SUNS
layout(location = 1) out vec4 sunDiffuse; // apart: what keeps D from a surface is not what keeps the suns from it
#ifdef HAS_SUN_SHADOWS
layout(location = 2) out vec4 sunShaded;  // what is left of that
#endif
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    diffuse = vec4(0.0);
#ifdef HAS_SUNS
    sunDiffuse = vec4(0.0);
#ifdef HAS_SUN_SHADOWS
    sunShaded = vec4(0.0);
#endif
#endif
    vec3 n = pixelNormal(p);
    vec3 rho = pixelAlbedo(p);
    float share = 1.0;  // of the albedo that diffuse light meets
#if defined(HAS_COOK_TORRANCE) || defined(HAS_BECKMANN) || defined(HAS_STRAUSS) || defined(HAS_COATS)
    // What the lobe reflects never reaches the layer below.
    Bsdf b = pixelBsdf(p, lobeView(p, n));
    rho *= b.body;
    share = dot(b.body, vec3(1.0 / 3.0));
#endif
    if (max(rho.r, max(rho.g, rho.b)) <= 0.0) return;
    vec3 mapNormal = mapFromEye * n;
    diffuse = vec4(rho * irradianceOverPi(mapNormal), share);
#ifdef HAS_SUNS
    SunIrradiance suns = sunIrradianceOverPi(mapNormal);
    sunDiffuse = vec4(rho * suns.whole, 1.0);
#ifdef HAS_SUN_SHADOWS
    sunShaded = vec4(rho * suns.seen, 1.0);
#endif
#endif
}
