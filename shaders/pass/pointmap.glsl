// SPDX-License-Identifier: MIT
// Shadow maps of points of lights, in the world about the maps' origin. A column of the table describes a point and its map:
//   row 0        position
//   row 1        alpha: nearest distance of the map
//   row 2        alpha: octaves of the map
//   rows 3 to 5  across, up and along the map; alpha: offset of the axis
//   row 6        centre of the window; alpha: half its width
#ifndef PASS_POINTMAP_GLSL
#define PASS_POINTMAP_GLSL

#include "lib/emittermap.glsl"

EmitterMap pointMap(sampler2D maps, sampler2D rows, int i, float nearest, float octaves, vec4 window)
{
    EmitterMap m;
    m.window = window.xy;
    m.tangent = window.w;
    m.nearest = nearest;
    m.octaves = octaves;
    int columns = int(ceil(sqrt(float(textureSize(rows, 0).x))));  // as EmitterMaps lays them out
    m.size = textureSize(maps, 0).x / columns;
    m.corner = ivec2(i % columns, i / columns) * m.size;
    return m;
}

// A surface along a map's axes, and where the map shows it; place.z is 0 beside the map.
struct PointMapView {
    vec3 position;
    vec3 normal;
    vec3 place;
};

PointMapView pointMapView(sampler2D rows, int i, EmitterMap m, vec3 p, vec3 n)
{
    mat3x4 axes = mat3x4(texelFetch(rows, ivec2(i, 3), 0), texelFetch(rows, ivec2(i, 4), 0), texelFetch(rows, ivec2(i, 5), 0));
    PointMapView v;
    v.normal = vec4(n, 0.0) * axes;
    vec3 inMap = vec4(p, 1.0) * axes;
    float cosine = abs(dot(v.normal, inMap)) * inversesqrt(max(dot(inMap, inMap), 1e-30));
    v.position = atlasLookupPoint(inMap, v.normal, cosine, emitterTexelWidth(m) * inMap.z);
    v.place = emitterMapPlace(m, v.position);
    return v;
}

#endif
