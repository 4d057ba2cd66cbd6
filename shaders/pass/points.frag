#version 330 compatibility
// SPDX-License-Identifier: MIT
// The map, the suns and lamps light the surface points [indirect2.md 6]. Each texel is a point. The colour is the irradiance over pi, in
// units of the map's mean; alpha is the share of the map's directions that the point sees.
#pragma import_defines(MAP_IS_BLACK, HAS_SUN_MAPS, HAS_AREA_LIGHTS, HAS_SCENE_LIGHT_MAPS)

#include "lib/constants.glsl"
#include "lib/limits.glsl"
#include "pass/atlas.glsl"
#ifdef HAS_SUN_MAPS
#include "pass/sunshadow.glsl"
#endif
#if defined(HAS_SUN_MAPS) || defined(HAS_SCENE_LIGHT_MAPS)
#define HAS_SMALL_LIGHTS
#endif
#if defined(HAS_AREA_LIGHTS) || defined(HAS_SCENE_LIGHT_MAPS)
#include "pass/pointmap.glsl"
uniform float radianceScale;
#endif
#ifdef HAS_AREA_LIGHTS
#include "pass/emitterpoints.glsl"
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
#include "pass/scenelights.glsl"
#include "pass/scenelightmaps.glsl"
#endif

uniform sampler2D pointPlaceMap;
uniform sampler2D pointNormalMap;
uniform vec3 pointsInAtlas;  // origin of the points about that of the atlas
uniform int pointRows;       // of every so many rows of points one is due in this frame
uniform int pointTurn;       // which one
uniform float pointLift;     // off their surfaces, which the suns' maps show more finely
#ifdef HAS_SMALL_LIGHTS
uniform sampler2D partPlaceMap;
uniform sampler2D partNormalMap;
#endif
#ifdef HAS_SUN_MAPS
uniform vec3 pointsInSunMaps;
#endif

#ifdef HAS_AREA_LIGHTS
uniform vec3 pointsInEmitterMaps;
#endif

#ifdef HAS_SCENE_LIGHT_MAPS
uniform vec3 pointsInSceneLightMaps;
uniform mat4 eyeFromPoints;
#endif

layout(location = 0) out vec4 light;

#ifdef HAS_SUN_MAPS
// Each part traces its own point of a sun's disc.
vec3 sunLight(vec3 place, vec3 n, int part)
{
    vec3 sum = vec3(0.0);
    SunPixel s = SunPixel(place + pointsInSunMaps + pointLift * n, n, -n, 0.0, 1.0, part);
    for (int i = 0; i < sunCount; ++i) {
        float e = discIrradianceOverPi(dot(n, sunAxes[3 * i + 2]), sunRadius[i]);
        if (e > 0.0) sum += e * sunSeen(i, s, 1).x * sunRadiance[i];
    }
    return sum;
}
#endif

#ifdef HAS_AREA_LIGHTS
// Of all their points.
vec3 areaLight(vec3 place, vec3 n)
{
    EmitterSums sums = EmitterSums(vec3(0.0), vec3(0.0), vec3(0.0));
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        float kernel = emitterKernel(e, e.position - place - pointsInEmitterMaps, n);
        if (kernel > 0.0) sums = withPoint(sums, kernel * e.power, emitterSees(e, place + pointsInEmitterMaps, n));
    }
    return seenLight(sums) / radianceScale;
}
#endif

#ifdef HAS_SCENE_LIGHT_MAPS
vec3 sceneLight(vec3 place, vec3 n)
{
    vec3 eye = vec3(eyeFromPoints * vec4(place, 1.0));
    vec3 eyeNormal = mat3(eyeFromPoints) * n;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < sceneLightCount; ++i) {
        vec3 direction;
        vec3 light = sceneLightAt(i, eye, direction);
        float c = dot(eyeNormal, direction);
        if (c > 0.0) sum += c * sceneLightSeen(i, place + pointsInSceneLightMaps, n) * light;
    }
    return sum / radianceScale;
}
#endif

#ifdef HAS_SMALL_LIGHTS
// What casts sharp shadows, or lights less than a point stands for: the mean over its parts.
vec3 smallLights(ivec2 p)
{
    vec3 sum = vec3(0.0);
    for (int k = 0; k < POINT_PART_SIDE * POINT_PART_SIDE; ++k) {
        ivec2 q = POINT_PART_SIDE * p + ivec2(k % POINT_PART_SIDE, k / POINT_PART_SIDE);
        vec3 place = texelFetch(partPlaceMap, q, 0).xyz;
        vec3 n = normalize(texelFetch(partNormalMap, q, 0).xyz);
#ifdef HAS_SUN_MAPS
        sum += sunLight(place, n, k);
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
        sum += sceneLight(place, n);
#endif
    }
    return sum / float(POINT_PART_SIDE * POINT_PART_SIDE);
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    if (p.y % pointRows != pointTurn) discard;
    vec3 place = texelFetch(pointPlaceMap, p, 0).xyz;
    vec3 n = texelFetch(pointNormalMap, p, 0).xyz;
    vec3 sum = vec3(0.0);
    float seen = 0.0;
    float all = 0.0;
    int perGroup = textureSize(atlasLightMap, 0).x;
    for (int group = 0; group < LIGHT_GROUPS; ++group)
        for (int i = 0; i < perGroup; ++i) {
            AtlasLight l = atlasLight(group, i);
            float c = dot(n, l.direction);
            if (c <= 0.0) continue;
            all += c * l.solidAngle;
            float sees = atlasSees(l, place + pointsInAtlas, n, c);
            seen += sees * c * l.solidAngle;
#ifndef MAP_IS_BLACK  // then the lights only say how much of the sphere is seen
            sum += sees * c * l.flux;
#endif
        }
    vec3 overPi = sum * INV_PI;
#ifdef HAS_SMALL_LIGHTS
    overPi += smallLights(p);
#endif
#ifdef HAS_AREA_LIGHTS
    overPi += areaLight(place, n);
#endif
    light = vec4(overPi, all > 0.0 ? seen / all : 1.0);
}
