#version 330 compatibility
// SPDX-License-Identifier: MIT
// Transparent surfaces of the host, drawn after the composite in its own bins: the same environment functions, one
// look-up for the lobe in place of the importance samples, no occlusion.
#pragma import_defines(HAS_SUNS, SUN_DIFFUSE)

#include "lib/frame.glsl"
#include "lib/octahedral.glsl"
#include "lib/sh.glsl"
#include "pass/surface.glsl"
#include "pass/albedo.glsl"
#ifdef HAS_SUNS
#include "pass/suns.glsl"
#endif
#include "pass/display.glsl"

uniform sampler2D pyramidMap;
uniform float pyramidSide;
uniform float pyramidLastLevel;
uniform vec3 shCoefficients[18];
uniform float radianceScale;
uniform mat3 mapFromEyeForward;

layout(location = 0) out vec4 color;

void main()
{
    Surface s = readSurface();
    vec3 v = -s.ray;
    float cosV = max(dot(s.normal, v), 1e-4);
    vec3 radiance = s.emission;
    vec3 through = vec3(1.0);
    float alpha = s.alpha;
    if (s.brdf != BRDF_LAMBERT) {
        vec2 e = s.brdf == BRDF_COOK_TORRANCE ? lobeAlbedo(s.roughness, cosV) : vec2(1.0, 0.0);
        vec3 reflected = s.f0 * e.x + e.y;
        // Half of a GGX lobe's energy lies within a cone of about tan = alpha.
        float lod = log2(max(s.roughness * s.roughness * pyramidSide, 1.0));
        vec3 r = mapFromEyeForward * reflect(-v, s.normal);
        vec3 glint = reflected * pyramidLookup(pyramidMap, pyramidSide, pyramidLastLevel, r, lod) * radianceScale;
#ifdef HAS_SUNS
        mat3 mapFromLocal = frameAround(mapFromEyeForward * s.normal);
        vec3 local = mapFromEyeForward * v * mapFromLocal;
        for (int i = 0; i < sunCount; ++i)
            glint += reflected * sunRadiance[i] * radianceScale *
                     ggxDisc(sunDirection[i] * mapFromLocal, local, max(s.roughness * s.roughness, 1e-3), sunRadius[i]);
#endif
        through = 1.0 - min(reflected, vec3(1.0));
        // A reflection does not fade with the body's transparency: blending multiplies by alpha, so alpha rises with it.
        float strength = max(reflected.r, max(reflected.g, reflected.b));
        alpha = mix(s.alpha, 1.0, clamp(strength, 0.0, 1.0));
        radiance += glint / max(alpha, 1e-3);
    }
    vec3 irradianceOverPi = shIrradiance(shCoefficients, mapFromEyeForward * s.normal);
#if defined(HAS_SUNS) && defined(SUN_DIFFUSE)
    irradianceOverPi += sunIrradianceOverPi(mapFromEyeForward * s.normal);
#endif
    vec3 diffuse = s.albedo * irradianceOverPi * radianceScale;
    radiance += diffuse * through * (s.alpha / max(alpha, 1e-3));
    color = vec4(display(radiance, ivec2(gl_FragCoord.xy)), alpha);
}
