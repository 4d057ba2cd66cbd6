#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces reflect of the application's lights, added to the emission: so everything that reads that has it.
#pragma import_defines(HAS_SCENE_LIGHT_MAPS)

#include "pass/gbuffer.glsl"
#include "pass/pixelbsdf.glsl"
#include "pass/scenelights.glsl"
#ifdef HAS_SCENE_LIGHT_MAPS
#include "pass/scenelightmaps.glsl"
uniform mat4 atlasFromEye;
#endif

layout(location = 0) out vec4 added;

// Half of the largest half float: the sum with an emission as large is still finite, and one infinite pixel would spread over
// all that filters and averages.
const float MOST = 32752.0;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    added = vec4(0.0);
    vec3 eye = pixelEye(p);
    vec3 n = pixelNormal(p);
    mat3 eyeFromLocal = pixelFrame(p, n);
    vec3 v = pixelView(p, eyeFromLocal);
    vec3 albedo = pixelAlbedo(p);
    Bsdf b = pixelBsdf(p, v);
#ifdef HAS_ROUGH_DIFFUSE
    RoughDiffuse layer = pixelRoughDiffuse(p, albedo * b.body);
#endif
#ifdef HAS_COATS
    bool coated = isCoated(p);
    PixelCoat coat = pixelCoat(p);
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
    vec3 normal = mat3(atlasFromEye) * n;
    // Off the surface by what its depth may be rounded.
    vec3 rounded = depthStep(inverseProjection, pixelNdc(p), texelFetch(depthMap, p, 0).r);
    vec3 place = vec3(atlasFromEye * vec4(eye, 1.0)) + normal * abs(dot(n, rounded));
#endif
    for (int i = 0; i < sceneLightCount; ++i) {
        vec3 direction;
        vec3 light = sceneLightAt(i, eye, direction);
        vec3 l = transpose(eyeFromLocal) * direction;
#ifdef HAS_SCENE_LIGHT_MAPS
        if (dot(n, direction) > 0.0) light *= sceneLightSeen(i, place, normal);
#endif
#ifdef HAS_ROUGH_DIFFUSE
        vec3 diffuse = pixelDiffuseBrdf(layer, p, n, direction);
#else
        vec3 diffuse = albedo * b.body;
#endif
        added.rgb += light * (lightLambert(diffuse, l) + lightLobe(b, v, l));
#ifdef HAS_COATS
        if (coated) added.rgb += light * lightLobe(coat.bsdf, coat.view, transpose(coat.eyeFromLocal) * direction);
#endif
    }
    added.rgb = min(added.rgb * exp2(-emittedStops), vec3(MOST));  // in the units of the emission's target
}
