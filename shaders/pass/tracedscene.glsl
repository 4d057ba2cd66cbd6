// SPDX-License-Identifier: MIT
// The scene's triangles as rays meet them. A surface has one colour.
#ifndef TRACEDSCENE_GLSL
#define TRACEDSCENE_GLSL

#include "pass/scenerays.glsl"
#include "pass/hostcolor.glsl"

uniform sampler2D rayNodeMap;
uniform sampler2D rayTriangleMap;
uniform sampler2D surfaceColorMap;  // SURFACE_TEXELS a surface

// What a surface reflects by its two layers, and how wide the lobe is.
struct TracedLayers {
    vec3 diffuse;
    vec3 glossy;
    float roughness;
};

TracedLayers tracedLayers(int surface)
{
    vec4 glossy = rayTexel(surfaceColorMap, SURFACE_TEXELS * surface + 1);
    return TracedLayers(rayTexel(surfaceColorMap, SURFACE_TEXELS * surface).rgb, glossy.rgb, glossy.a);
}

// Share of light that both reflect.
vec3 tracedReflectance(SceneHit hit)
{
    TracedLayers layers = tracedLayers(hit.surface);
    return layers.diffuse + layers.glossy;
}

vec3 tracedEmission(SceneHit hit)
{
    return rayTexel(surfaceColorMap, SURFACE_TEXELS * hit.surface + 2).rgb * emittedScale();
}

#endif
