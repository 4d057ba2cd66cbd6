#version 330 compatibility
// SPDX-License-Identifier: MIT
// What other surfaces send to a pixel of a still view: rays in directions that a Lambert surface weighs alike, and what they meet
// [final gathering: Reichert 1992; Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, 8.4]. Each frame takes other
// directions.
#pragma import_defines(HAS_CAUSTICS)

#include "pass/pathlight.glsl"

uniform int accumulateRays;
#ifdef HAS_CAUSTICS
uniform int reflectedLights;  // for which virtual lights stand
#else
const int reflectedLights = 0;
#endif

// Radiance that a white surface would send on.
layout(location = 0) out vec4 rayLight;

// From a ray to the next of a frame: 65536 points of the R2 sequence further on, where the frames do not come.
const vec2 NEXT_RAY = vec2(0.0533108, 0.6627351);

// Mirrors on a path that begins at a Lambert layer reflect lamps as if they had at least this roughness. Balls under a sun after 32 frames,
// beside full light transport: tRMSE 1.035, 1.029, 1.032 % with .2, .4, .8.
const float GATHER_BLUR = 0.4;

// Radiance that comes along a ray, in units of the map's mean.
vec3 lightAlong(vec3 origin, vec3 along, uint pixel, uint ray)
{
    SceneHit met = nextHit(origin, along);
    if (met.distance == MISSED) return vec3(0.0);
    return tracedEmission(met) / radianceScale + pathLight(pathSurface(met, origin, along), GATHER_BLUR, reflectedLights, pixel, ray);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 n = pixelNormal(p);
    vec3 origin = vec3(placesFromEye * vec4(rayOrigin(p, n), 1.0));
    vec3 placesNormal = mat3(placesFromEye) * n;
    vec2 first = rayPoint(p);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < accumulateRays; ++k) {
        uint number = uint(sampleFrames) * uint(accumulateRays) + uint(k);
        GuidedRay ray = guidedRay(origin, placesNormal, fract(first + float(k) * NEXT_RAY), pixelNumber(rayPixel(p), 0x10000000u + number));
        if (ray.weight <= 0.0) continue;
        sum += ray.weight * lightAlong(origin, ray.along, rayPixel(p), number);
    }
    rayLight = vec4(radianceScale * sum / float(accumulateRays), 1.0);
}
