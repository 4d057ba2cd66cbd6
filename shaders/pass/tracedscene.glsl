// SPDX-License-Identifier: MIT
// The scene's triangles as rays meet them. A surface has one colour.
#ifndef TRACEDSCENE_GLSL
#define TRACEDSCENE_GLSL

#include "pass/scenerays.glsl"
#include "pass/hostcolor.glsl"

uniform sampler2D rayNodeMap;
uniform sampler2D rayTriangleMap;
uniform sampler2D surfaceColorMap;  // two texels a surface

// Share of light that its layers reflect.
vec3 tracedReflectance(SceneHit hit)
{
    return rayTexel(surfaceColorMap, 2 * hit.surface).rgb;
}

vec3 tracedEmission(SceneHit hit)
{
    return rayTexel(surfaceColorMap, 2 * hit.surface + 1).rgb * emittedScale();
}

#endif
