#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces reflect of the application's lights, without shadows, added to the emission: so everything that reads that has it.
#pragma import_defines(HAS_PHONG, HAS_COOK_TORRANCE)

#include "lib/frame.glsl"
#include "pass/gbuffer.glsl"
#include "pass/albedo.glsl"
#include "pass/scenelights.glsl"

layout(location = 0) out vec4 added;

// Half of the largest half float: the sum with an emission as large is still finite, and one infinite pixel would spread over
// all that filters and averages.
const float MOST = 32752.0;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    added = vec4(0.0);
    vec3 eye = pixelEye(p);
    mat3 eyeFromLocal = frameAround(pixelNormal(p));
    vec3 v = pixelView(p, eyeFromLocal);
    vec3 albedo = texelFetch(albedoMap, p, 0).rgb;
    float roughness = texelFetch(normalMap, p, 0).a;
    int brdf = pixelBrdf(p);
    vec3 f0 = texelFetch(specularMap, p, 0).rgb;
    vec3 energy = vec3(1.0);
#ifdef HAS_COOK_TORRANCE
    // As in pass/diffuse.frag: what the lobe reflects never reaches the layer below.
    if (brdf == BRDF_COOK_TORRANCE) {
        vec2 e = lobeAlbedo(roughness, v.z);
        energy = multipleScattering(f0, e.x + e.y);
        albedo *= max(1.0 - (f0 * e.x + e.y) * energy, vec3(0.0));
    }
#endif
    for (int i = 0; i < sceneLightCount; ++i) {
        vec3 direction;
        vec3 light = sceneLightAt(i, eye, direction);
        vec3 l = transpose(eyeFromLocal) * direction;
        vec3 reflected = lightLambert(albedo, l);
#ifdef HAS_PHONG
        if (brdf == BRDF_PHONG) reflected += lightPhong(f0, v, l, roughness);
#endif
#ifdef HAS_COOK_TORRANCE
        if (brdf == BRDF_COOK_TORRANCE) reflected += lightCookTorrance(f0, energy, v, l, roughness);
#endif
        added.rgb += light * reflected;
    }
    added.rgb = min(added.rgb * exp2(-emittedStops), vec3(MOST));  // in the units of the emission's target
}
