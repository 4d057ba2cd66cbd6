// SPDX-License-Identifier: MIT
// When an area light may be taken as a point.
#ifndef FARLIGHT_GLSL
#define FARLIGHT_GLSL

// A light at this many of its radii or more is taken as a point: the error is a third of the number's inverse square, .3 %. It is
// no larger where a lobe is this many times as wide as the light.
const float FAR_LIGHT = 10.0;

// Whether a light is as far as that from a surface of unit normal n, and wholly above its horizon.
// place: the light's, from the surface; squareRadius: of what holds the light
bool isFarLight(vec3 place, float squareRadius, vec3 n)
{
    float height = dot(n, place);
    return FAR_LIGHT * FAR_LIGHT * squareRadius < dot(place, place) && height > 0.0 && height * height > squareRadius;
}

#endif
