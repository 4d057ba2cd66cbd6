// SPDX-License-Identifier: MIT
// The application's fog before the scene. It takes its share of the light before that is shown, so that a still view averages what it
// shows; reflections look through the fog before the eye alone.
#ifndef PASS_FOG_GLSL
#define PASS_FOG_GLSL

#include "lib/fog.glsl"

uniform vec3 fogRadiance;
uniform int fogKind;
uniform int fogIsRadial;  // by the distance from the eye, else from the plane of the eye
uniform float fogDensity;
uniform float fogStart;
uniform float fogEnd;

// Of the light from a point in eye space.
float fogLeaves(vec3 eye)
{
    return fogTransmittance(fogKind, fogIsRadial != 0 ? length(eye) : abs(eye.z), fogDensity, fogStart, fogEnd);
}

#endif
