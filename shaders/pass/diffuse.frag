#version 330 compatibility
// SPDX-License-Identifier: MIT
// D: the diffuse term without occlusion, rho/pi times the integral of L cos [seed 000, eq. 3, second term]. Alpha is the share of the
// albedo that light from everywhere meets.
// Radiance in units of the map's mean.
#pragma import_defines(HAS_SUNS, HAS_SUN_SHADOWS, UNSHADED_SUNS)

#include "lib/constants.glsl"
#include "pass/gbuffer.glsl"
#include "pass/pixelbsdf.glsl"
#include "pass/irradiance.glsl"
#ifdef HAS_SUNS
#include "pass/suns.glsl"
#endif

layout(location = 0) out vec4 diffuse;
// Of the suns apart: what keeps D from a surface is not what keeps them from it.
#ifdef HAS_SUN_SHADOWS
layout(location = 1) out vec4 sunShaded;
#ifdef UNSHADED_SUNS
layout(location = 2) out vec4 sunDiffuse;
#endif
#elif defined(UNSHADED_SUNS)
layout(location = 1) out vec4 sunDiffuse;
#endif

// ofSky() is the radiance that the diffuse layer reflects of the map. ofDirection() is pi times its BRDF for light from one direction.
#ifdef HAS_ROUGH_DIFFUSE
vec3 ofSky(RoughDiffuse d, ivec2 p, vec3 mapNormal)
{
    return roughDiffuseOfSky(d, mapNormal, mapFromEye * -viewRay(inverseProjection, pixelNdc(p)), irradianceOverPi(mapNormal), shCoefficients);
}

vec3 ofDirection(RoughDiffuse d, ivec2 p, vec3 n, vec3 mapDirection)
{
    return pixelDiffuseBrdf(d, p, n, mapDirection * mapFromEye);
}
#else
vec3 ofSky(vec3 rho, ivec2 p, vec3 mapNormal)
{
    return rho * irradianceOverPi(mapNormal);
}

vec3 ofDirection(vec3 rho, ivec2 p, vec3 n, vec3 mapDirection)
{
    return rho;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    diffuse = vec4(0.0);
#ifdef UNSHADED_SUNS
    sunDiffuse = vec4(0.0);
#endif
#ifdef HAS_SUN_SHADOWS
    sunShaded = vec4(0.0);
#endif
    vec3 n = pixelNormal(p);
    vec3 rho = pixelAlbedo(p);
    float share = 1.0;
#if defined(HAS_COOK_TORRANCE) || defined(HAS_BECKMANN) || defined(HAS_STRAUSS) || defined(HAS_COATS)
    // What the lobe reflects never reaches the layer below.
    Bsdf b = pixelBsdf(p, lobeView(p, n));
    rho *= b.body;
    share = dot(b.body, vec3(1.0 / 3.0));
#endif
    if (max(rho.r, max(rho.g, rho.b)) <= 0.0) return;
    vec3 mapNormal = mapFromEye * n;
#ifdef HAS_ROUGH_DIFFUSE
    RoughDiffuse layer = pixelRoughDiffuse(p, rho);
    vec3 sent = roughDiffuseAlbedo(layer, max(dot(n, -viewRay(inverseProjection, pixelNdc(p))), 0.0));
    share *= dot(sent, vec3(1.0)) / dot(rho, vec3(1.0));
#else
    vec3 layer = rho;
#endif
    diffuse = vec4(ofSky(layer, p, mapNormal), share);
#ifdef HAS_SUNS
    for (int i = 0; i < sunCount; ++i) {
        vec3 sun = ofDirection(layer, p, n, sunDirection[i]) * sunIrradianceOverPi(i, mapNormal);
#ifdef UNSHADED_SUNS
        sunDiffuse.rgb += sun;
#endif
#ifdef HAS_SUN_SHADOWS
        sunShaded.rgb += sunVisibility(i) * sun;
#endif
    }
#endif
}
