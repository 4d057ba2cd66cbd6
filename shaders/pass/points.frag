#version 330 compatibility
// SPDX-License-Identifier: MIT
// The map, the suns and lamps light the surface points [indirect2.md 6]. Each texel is a point. The colour is the irradiance over pi, in
// units of the map's mean; alpha is the share of the map's directions that the point sees.
// Where surfaces are glossy, a second target holds what mirrors at the points send to other surfaces. A point sends light evenly, so other
// surfaces receive only a share: that of the directions in which they hide the map. A mirror sends each light in one direction. Only the
// lights for which a surface lies there count. The colour is their irradiance over pi, divided by the share; other surfaces then receive
// all of it. Alpha is the same factor for the light that surfaces send to the point.
// Virtual lights may stand for what polished metal reflects of a sun or lamp. Points on the metal then send nothing of that sun or lamp, and
// all points receive the virtual lights.
#pragma import_defines(MAP_IS_BLACK, HAS_SUN_MAPS, HAS_AREA_LIGHTS, HAS_SCENE_LIGHT_MAPS, HAS_GLOSS, HAS_CAUSTICS)

#include "lib/constants.glsl"
#include "lib/limits.glsl"
#include "lib/sequence.glsl"
#include "pass/atlas.glsl"
#include "pass/receivedlight.glsl"
#ifdef HAS_SUN_MAPS
#include "pass/sunshadow.glsl"
#endif
#ifdef HAS_CAUSTICS
#include "pass/virtuallights.glsl"
#endif
#if defined(HAS_SUN_MAPS) || defined(HAS_SCENE_LIGHT_MAPS)
#define HAS_SMALL_LIGHTS
#endif

uniform sampler2D pointPlaceMap;
uniform sampler2D pointNormalMap;
uniform vec3 placesInAtlas;  // origin of the points about that of the atlas
uniform int pointRows;       // of every so many rows of points one is due in this frame
uniform int pointTurn;       // which one
#ifdef HAS_SUN_MAPS
uniform vec3 pointsInSunMaps;
#endif
#ifdef HAS_CAUSTICS
uniform sampler2D pointGlossyMap;  // alpha: 1 if virtual lights stand for what it reflects
uniform int reflectedLights;       // bits: of suns and the application's lights, as receive() numbers them
uniform float pointWidth;          // half of what lies between points
#endif
#ifdef HAS_SMALL_LIGHTS
uniform sampler2D partPlaceMap;
uniform sampler2D partNormalMap;
#endif
layout(location = 0) out vec4 light;
#ifdef HAS_GLOSS
layout(location = 1) out vec4 mirrored;

const float LEAST_HIDDEN = 0.1;  // share of directions; points that see nearly all of the map would send without end
#endif

// A mirror at the point sends light from direction l one way. 1 if a surface lies that way, else 0. It does if it hides the atlas light
// nearest to that way. Near the horizon that light may lie below the point's own surface. The answer is then `hidden`, which says whether
// a surface hides l.
float mirrorMeets(vec3 l, float hidden, vec3 place, vec3 n)
{
#ifdef HAS_GLOSS
    vec3 d = 2.0 * dot(n, l) * n - l;
    int number = int(texelFetch(nearestLightMap, nearestLightTexel(d), 0).x & 0xffffu);
    AtlasLight nearest = atlasLight(number % LIGHT_GROUPS, number / LIGHT_GROUPS);
    float c = dot(n, nearest.direction);
    return c > 0.0 ? 1.0 - atlasSees(nearest, place + placesInAtlas, n) : hidden;
#else
    return 0.0;
#endif
}

float sentShare(vec3 l, vec3 place, vec3 n, int number)
{
#ifdef HAS_CAUSTICS
    bool isVirtual = (reflectedLights >> number & 1) == 1 && texelFetch(pointGlossyMap, ivec2(gl_FragCoord.xy), 0).a > 0.5;
    if (isVirtual) return 0.0;
#endif
    return mirrorMeets(l, 0.0, place, n);
}

#ifdef HAS_CAUSTICS
// Of a sixteenth of them, others at each neighbour.
vec3 fromVirtualLights(ivec2 p, vec3 place, vec3 n)
{
    int count = textureSize(virtualLightMap, 0).x / 16;
    int group = bayer4(p.x, p.y);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) sum += fromVirtualLight(group * count + i, place, n, pointWidth);
    return 16.0 * sum;
}
#endif

#ifdef HAS_SUN_MAPS
// Each part traces its own point of a sun's disc.
void receiveSuns(vec3 place, vec3 n, int part, inout ReceivedLight sum)
{
    SunPixel s = SunPixel(place + pointsInSunMaps, n, 0.0, -n, 0.0, 1.0, part);
    for (int i = 0; i < sunCount; ++i) {
        vec3 l = sunAxes[3 * i + 2];
        float e = discIrradianceOverPi(dot(n, l), sunRadius[i]);
        if (e > 0.0) receive(e * sunSeen(i, s, 1).x * sunRadiance[i], l, place, n, FIRST_SUN + i, sum);
    }
}
#endif

#ifdef HAS_SMALL_LIGHTS
// What casts sharp shadows, or lights less than a point stands for: the mean over its parts.
void receiveSmallLights(ivec2 p, inout ReceivedLight sum)
{
    const int parts = POINT_PART_SIDE * POINT_PART_SIDE;
    ReceivedLight ofParts = ReceivedLight(vec3(0.0), vec3(0.0));
    for (int k = 0; k < parts; ++k) {
        ivec2 q = POINT_PART_SIDE * p + ivec2(k % POINT_PART_SIDE, k / POINT_PART_SIDE);
        vec3 place = texelFetch(partPlaceMap, q, 0).xyz;
        vec3 n = normalize(texelFetch(partNormalMap, q, 0).xyz);
#ifdef HAS_SUN_MAPS
        receiveSuns(place, n, k, ofParts);
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
        receiveSceneLights(place, n, ofParts);
#endif
    }
    sum.all += ofParts.all / float(parts);
    sum.sentOn += ofParts.sentOn / float(parts);
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    if (p.y % pointRows != pointTurn) discard;
    vec3 place = texelFetch(pointPlaceMap, p, 0).xyz;
    vec3 n = texelFetch(pointNormalMap, p, 0).xyz;
    ReceivedLight sum = ReceivedLight(vec3(0.0), vec3(0.0));
    float seen = 0.0;
    float all = 0.0;
    float between = 0.0;  // of what surfaces send here, what a mirror sends to others
    int perGroup = textureSize(atlasLightMap, 0).x;
    for (int group = 0; group < LIGHT_GROUPS; ++group)
        for (int i = 0; i < perGroup; ++i) {
            AtlasLight l = atlasLight(group, i);
            float c = dot(n, l.direction);
            if (c <= 0.0) continue;
            all += c * l.solidAngle;
            float sees = atlasSees(l, place + placesInAtlas, n);
            seen += sees * c * l.solidAngle;
            float meets = mirrorMeets(l.direction, 1.0 - sees, place, n);
            between += meets * (1.0 - sees) * c * l.solidAngle;
#ifndef MAP_IS_BLACK  // then the lights only say how much of the sphere is seen
            vec3 e = sees * c * INV_PI * l.flux;
            sum.all += e;
            sum.sentOn += meets * e;
#endif
        }
#ifdef HAS_SMALL_LIGHTS
    receiveSmallLights(p, sum);
#endif
#ifdef HAS_AREA_LIGHTS
    receiveAreaLights(place, n, sum);
#endif
#ifdef HAS_CAUSTICS
    sum.all += fromVirtualLights(p, place, n);
#endif
    light = vec4(sum.all, all > 0.0 ? seen / all : 1.0);
#ifdef HAS_GLOSS
    float hidden = 1.0 - light.a;
    mirrored = vec4(sum.sentOn, between / max(all - seen, 1e-20)) / max(hidden, LEAST_HIDDEN);
#endif
}
