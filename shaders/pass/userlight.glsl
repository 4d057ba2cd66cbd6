// SPDX-License-Identifier: MIT
// The environment's light for the application's own fragment shaders [osgEnvLight/LightShader].
#pragma import_defines(ENVLIGHT_LIT)

#include "lib/depth.glsl"
#include "pass/forwardlight.glsl"
#include "pass/hostcolor.glsl"

// position, normal: in eye space; the normal of any length and side. baseColor: linear, with opacity. emission: linear radiance.
vec4 envlightLit(vec3 position, vec3 normal, vec4 baseColor, float metalness, float roughness, vec3 emission)
{
    vec3 ray = viewRayAt(gl_ProjectionMatrixInverse, position);
    vec3 n = dot(normal, normal) > 0.0 ? normalize(normal) : -ray;
    if (dot(n, ray) > 0.0) n = -n;
#ifdef ENVLIGHT_LIT
    Surface s = blackSurface(position, ray, n);
    s.alpha = baseColor.a;
    s.albedo = baseColor.rgb * (1.0 - metalness);
    s.f0 = mix(vec3(DIELECTRIC_F0), baseColor.rgb, metalness);
    s.brdf = BRDF_COOK_TORRANCE;
    s.roughness = roughness;
    s.emission = emission * emittedScale();
    return forwardColor(s);
#else
    // Without a LitScene above: a lamp at the eye.
    return vec4(srgbEncode3(clamp(baseColor.rgb * max(-dot(n, ray), 0.0) + emission, 0.0, 1.0)), baseColor.a);
#endif
}

vec4 envlightLit(vec3 position, vec3 normal, vec4 baseColor, float metalness, float roughness)
{
    return envlightLit(position, normal, baseColor, metalness, roughness, vec3(0.0));
}
