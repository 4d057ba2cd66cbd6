// SPDX-License-Identifier: MIT
// The points that stand for the area lights, and their shadow maps, in the world about the maps' origin.
#ifndef PASS_EMITTERPOINTS_GLSL
#define PASS_EMITTERPOINTS_GLSL

#include "lib/constants.glsl"
#include "pass/pointmap.glsl"

uniform sampler2D emitterMaps;
uniform sampler2D emitterPointMap; // as pass/pointmap.glsl says, and beside these the area of the point's part; its normal; its radiance
                                   // times the area; the scale of sums; its power if the light were even, half the
                                   // width of its map's widest window, negative if the light is round

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
    e.map = pointMap(emitterMaps, emitterPointMap, i, normal.w, power.w, window);
    e.index = i;
    return e;
}

// The power of the point if its light sent as much from everywhere.
vec3 evenPower(EmitterPoint e)
{
    return texelFetch(emitterPointMap, ivec2(e.index, 7), 0).rgb;
}

// The share of a point's power that a surface of unit normal n receives, as irradiance over pi. It is the product of both cosines over pi
// times the squared distance. The area of the part keeps it finite close by [area-lights.md 3, "Kernel"]. to: from the surface to the
// point.
float emitterKernel(EmitterPoint e, vec3 to, vec3 n)
{
    float square = max(dot(to, to), 1e-30);
    return max(dot(n, to), 0.0) * max(-dot(e.normal, to), 0.0) / (square * (PI * square + e.area));
}

// The share of the point that the surface at p with unit normal n sees: 1 or 0, and between them over a texel at a shadow's edge. The
// point's map is a pyramid and does not reach directions that graze the light. There a flat light counts as seen: none of its points
// reaches them. A round light gives -1, unknown: other points of it face there and replace this one. Without that, a lamp shines
// through its shade.
float emitterSees(EmitterPoint e, vec3 p, vec3 n)
{
    if (e.map.tangent <= 0.0) return 1.0;
    PointMapView v = pointMapView(emitterPointMap, e.index, e.map, p, n);
    if (v.place.z <= 0.0) {
        float widest = texelFetch(emitterPointMap, ivec2(e.index, 7), 0).a;
        bool grazes = max(abs(v.position.x), abs(v.position.y)) > abs(widest) * v.position.z;
        return grazes && widest < 0.0 ? -1.0 : 1.0;
    }
    return emitterMapLinearShare(emitterMaps, e.map, v.position, v.normal, v.place);
}

// What points send to a surface: all of them, those that know whether they are seen, and those that are.
struct EmitterSums {
    vec3 all;
    vec3 known;
    vec3 seen;
};

EmitterSums withPoint(EmitterSums sums, vec3 received, float seen)
{
    sums.all += received;
    if (seen < 0.0) return sums;
    sums.known += received;
    sums.seen += seen * received;
    return sums;
}

// The factor by which the points that know replace those that do not.
vec3 knownScale(EmitterSums sums)
{
    return mix(vec3(1.0), sums.all / max(sums.known, vec3(1e-30)), greaterThan(sums.known, vec3(0.0)));
}

// Where none knows, all are seen.
vec3 seenLight(EmitterSums sums)
{
    return mix(sums.all, knownScale(sums) * sums.seen, greaterThan(sums.known, vec3(0.0)));
}

#endif
