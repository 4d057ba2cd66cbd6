// SPDX-License-Identifier: MIT
// The lights whose reflections by polished surfaces are followed, about the origin of surface points.
#ifndef REFLECTEDLIGHTS_GLSL
#define REFLECTEDLIGHTS_GLSL

#include "lib/limits.glsl"

uniform vec4 reflectedPosition[MOST_REFLECTED_LIGHTS];  // w = 0: the direction to it
uniform vec4 reflectedAxis[MOST_REFLECTED_LIGHTS];      // of its map, and a texel's area across it; of a light with a place, at distance 1

struct ReflectedLight {
    vec3 direction;  // to it
    float texelArea; // of its map at that place, across the direction
};

ReflectedLight reflectedLight(int number, vec3 place)
{
    vec4 position = reflectedPosition[number];
    vec4 axis = reflectedAxis[number];
    vec3 to = position.xyz - position.w * place;
    float square = max(dot(to, to), 1e-30);
    ReflectedLight light;
    light.direction = to * inversesqrt(square);
    float cosine = max(dot(light.direction, axis.xyz), 0.0);
    light.texelArea = position.w > 0.0 ? axis.w * square * cosine * cosine * cosine : axis.w;
    return light;
}

#endif
