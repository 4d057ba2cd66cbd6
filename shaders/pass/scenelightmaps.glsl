// SPDX-License-Identifier: MIT
// What hides the application's lights, by their shadow maps.
#ifndef PASS_SCENELIGHTMAPS_GLSL
#define PASS_SCENELIGHTMAPS_GLSL

#include "lib/limits.glsl"
#include "pass/pointmap.glsl"

uniform sampler2D sceneLightMaps;
uniform sampler2D sceneLightPointMap;              // rows as pass/pointmap.glsl says
uniform ivec2 sceneLightFaces[MOST_SCENE_LIGHTS];  // a light's first map, and how many: none, one, or the six faces of a cube

// How much of light i reaches p, in the world about the maps' origin, with unit normal n.
float sceneLightSeen(int i, vec3 p, vec3 n)
{
    ivec2 faces = sceneLightFaces[i];
    if (faces.y == 0) return 1.0;
    int at = faces.x;
    if (faces.y == 6) at += cubeFace(p - texelFetch(sceneLightPointMap, ivec2(at, 0), 0).xyz);
    vec4 window = texelFetch(sceneLightPointMap, ivec2(at, 6), 0);
    if (window.w <= 0.0) return 1.0;
    float nearest = texelFetch(sceneLightPointMap, ivec2(at, 1), 0).w;
    float octaves = texelFetch(sceneLightPointMap, ivec2(at, 2), 0).w;
    EmitterMap m = pointMap(sceneLightMaps, sceneLightPointMap, at, nearest, octaves, window);
    PointMapView v = pointMapView(sceneLightPointMap, at, m, p, n);
    return v.place.z > 0.0 ? emitterMapShare(sceneLightMaps, m, v.position, v.normal, v.place) : 1.0;
}

#endif
