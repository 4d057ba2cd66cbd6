// SPDX-License-Identifier: MIT
// The application's lights, in eye space.
#ifndef PASS_SCENELIGHTS_GLSL
#define PASS_SCENELIGHTS_GLSL

#include "lib/limits.glsl"
#include "lib/scenelight.glsl"
#include "pass/hostcolor.glsl"

uniform int sceneLightCount;
uniform vec3 sceneLightColor[MOST_SCENE_LIGHTS];
uniform vec4 sceneLightPosition[MOST_SCENE_LIGHTS]; // w = 0: direction to it
uniform vec4 sceneLightSpot[MOST_SCENE_LIGHTS];     // direction, cosine of the cutoff; below -1: no cone
uniform vec4 sceneLightFalloff[MOST_SCENE_LIGHTS];  // constant, linear, quadratic; exponent of the spot

// The colour of light i at a point, and the unit direction to it.
vec3 sceneLightAt(int i, vec3 eye, out vec3 direction)
{
    vec4 position = sceneLightPosition[i];
    vec3 to = position.xyz - position.w * eye;
    float distance = length(to);
    direction = to / max(distance, 1e-20);
    vec3 light = hostRadiance(sceneLightColor[i]);
    vec4 falloff = sceneLightFalloff[i];
    if (position.w > 0.0) light *= lightAttenuation(falloff.xyz, distance);
    vec4 spot = sceneLightSpot[i];
    if (spot.w >= -1.0) light *= lightCone(-dot(direction, spot.xyz), spot.w, falloff.w);
    return light;
}

#endif
