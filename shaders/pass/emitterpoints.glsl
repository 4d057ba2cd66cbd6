// SPDX-License-Identifier: MIT
// The points that stand for the area lights, and their shadow maps, in the world about the maps' origin.
#ifndef PASS_EMITTERPOINTS_GLSL
#define PASS_EMITTERPOINTS_GLSL

#include "lib/constants.glsl"
#include "lib/emittermap.glsl"

uniform sampler2D emitterMaps;
uniform sampler2D emitterPointMap; // rows of a point: position and area of its part; normal, the nearest distance of its map; radiance
                                   // times the part's area, the map's octaves; across, up and along the map with the offsets of these
                                   // axes; the window's centre, the scale of sums, half the window's width

struct EmitterPoint {
    vec3 position;
    vec3 normal;
    vec3 power;
    float area;
    float scale;  // by which sums of what points send fit half floats
    EmitterMap map;
    int index;
};

EmitterPoint emitterPoint(int i)
{
    EmitterPoint e;
    vec4 place = texelFetch(emitterPointMap, ivec2(i, 0), 0);
    vec4 normal = texelFetch(emitterPointMap, ivec2(i, 1), 0);
    vec4 power = texelFetch(emitterPointMap, ivec2(i, 2), 0);
    vec4 window = texelFetch(emitterPointMap, ivec2(i, 6), 0);
    e.position = place.xyz;
    e.normal = normal.xyz;
    e.power = power.rgb;
    e.area = place.w;
    e.scale = window.z;
    e.map.window = window.xy;
    e.map.tangent = window.w;
    e.map.nearest = normal.w;
    e.map.octaves = power.w;
    int columns = int(ceil(sqrt(float(textureSize(emitterPointMap, 0).x))));  // as EmitterMaps lays them out
    e.map.size = textureSize(emitterMaps, 0).x / columns;
    e.map.corner = ivec2(i % columns, i / columns) * e.map.size;
    e.index = i;
    return e;
}

// The share of a point's power that a surface of unit normal n receives, as irradiance over pi. It is the product of both cosines over pi
// times the squared distance. The area of the part keeps it finite close by [area-lights.md 3, "Kernel"]. to: from the surface to the
// point.
float emitterKernel(EmitterPoint e, vec3 to, vec3 n)
{
    float square = max(dot(to, to), 1e-30);
    return max(dot(n, to), 0.0) * max(-dot(e.normal, to), 0.0) / (square * (PI * square + e.area));
}

// 1 if the point is seen from p with unit normal n, else 0; 1 outside its map.
float emitterSees(EmitterPoint e, vec3 p, vec3 n)
{
    if (e.map.tangent <= 0.0) return 1.0;
    mat3x4 axes = mat3x4(texelFetch(emitterPointMap, ivec2(e.index, 3), 0), texelFetch(emitterPointMap, ivec2(e.index, 4), 0),
                         texelFetch(emitterPointMap, ivec2(e.index, 5), 0));
    vec3 inMap = vec4(p, 1.0) * axes;
    vec3 normal = vec4(n, 0.0) * axes;
    float cosine = abs(dot(normal, inMap)) * inversesqrt(max(dot(inMap, inMap), 1e-30));
    inMap = atlasLookupPoint(inMap, normal, cosine, emitterTexelWidth(e.map) * inMap.z);
    vec3 place = emitterMapPlace(e.map, inMap);
    if (place.z <= 0.0) return 1.0;
    return emitterMapSees(emitterMaps, e.map, place, emitterMapRise(e.map, inMap, normal, place.xy));
}

#endif
