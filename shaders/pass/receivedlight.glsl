// SPDX-License-Identifier: MIT
// The light of lamps at a place on a surface of the scene that stands still. Who includes this defines sentShare().
#ifndef RECEIVEDLIGHT_GLSL
#define RECEIVEDLIGHT_GLSL
#pragma import_defines(HAS_AREA_LIGHTS, HAS_SCENE_LIGHT_MAPS)

#include "lib/limits.glsl"
#if defined(HAS_AREA_LIGHTS) || defined(HAS_SCENE_LIGHT_MAPS)
#include "pass/pointmap.glsl"
#endif
#ifdef HAS_AREA_LIGHTS
#include "pass/emitterpoints.glsl"
uniform vec3 placesInEmitterMaps;
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
#include "pass/scenelights.glsl"
#include "pass/scenelightmaps.glsl"
uniform vec3 placesInSceneLightMaps;
uniform mat4 eyeFromPlaces;
#endif

uniform float radianceScale;

// Irradiance over pi, in units of the map's mean.
struct ReceivedLight {
    vec3 all;
    vec3 sentOn;  // of each light the share that sentShare() says
};

// The share of light from direction l that a lobe there sends where it counts. number: the light's. The application's lights come first,
// then the suns. Other lights have NO_NUMBER.
const int FIRST_SUN = MOST_SCENE_LIGHTS;
const int NO_NUMBER = FIRST_SUN + MOST_SUNS;
float sentShare(vec3 l, vec3 place, vec3 n, int number);

void receive(vec3 e, vec3 l, vec3 place, vec3 n, int number, inout ReceivedLight sum)
{
    sum.all += e;
    sum.sentOn += e * sentShare(l, place, n, number);
}

#ifdef HAS_AREA_LIGHTS
// Of all their points.
void receiveAreaLights(vec3 place, vec3 n, inout ReceivedLight sum)
{
    EmitterSums sums = EmitterSums(vec3(0.0), vec3(0.0), vec3(0.0));
    ReceivedLight seen = ReceivedLight(vec3(0.0), vec3(0.0));
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        vec3 to = e.position - place - placesInEmitterMaps;
        float kernel = emitterKernel(e, to, n);
        if (kernel <= 0.0) continue;
        float sees = emitterSees(e, place + placesInEmitterMaps, n);  // negative: not known, and counts as seen for the mirror
        sums = withPoint(sums, kernel * e.power, sees);
        receive(abs(sees) * kernel * e.power, normalize(to), place, n, NO_NUMBER, seen);
    }
    vec3 received = seenLight(sums) / radianceScale;
    sum.all += received;
    sum.sentOn += received * seen.sentOn / max(seen.all, vec3(1e-30));
}
#endif

#ifdef HAS_SCENE_LIGHT_MAPS
void receiveSceneLights(vec3 place, vec3 n, inout ReceivedLight sum)
{
    vec3 eye = vec3(eyeFromPlaces * vec4(place, 1.0));
    vec3 eyeNormal = mat3(eyeFromPlaces) * n;
    for (int i = 0; i < sceneLightCount; ++i) {
        vec3 direction;
        vec3 light = sceneLightAt(i, eye, direction);
        float c = dot(eyeNormal, direction);
        if (c <= 0.0) continue;
        vec3 e = c * sceneLightSeen(i, place + placesInSceneLightMaps, n) / radianceScale * light;
        receive(e, direction * mat3(eyeFromPlaces), place, n, i, sum);
    }
}
#endif

#endif
