// SPDX-License-Identifier: MIT
// Where does a ray meet a triangle of the scene? Two textures hold a hierarchy of boxes over the triangles. A node has two texels, the
// corners of its box. The alpha of the first is the number of the node's first child; the second child follows it. A leaf has a negative
// number there: -(RAY_LEAF * its first triangle + how many it has). A triangle has four texels. The first is
// a corner; its alpha is the number of the surface. Two are the edges from that corner; the first edge's alpha is the surface's opacity.
// The last holds the normals of the three corners by packDirection(), negative if the triangle is flat.
#ifndef SCENERAYS_GLSL
#define SCENERAYS_GLSL

#include "lib/limits.glsl"
#include "lib/octahedral.glsl"

const float MISSED = 3e38;

// A surface with holes, or a transparent one, stops a ray in a share of its places that is its opacity. The mean over rays is right.
const float STOPS_BY_PLACE = -1.0;
// Or it stops every ray if its opacity is at least this. A mirror, which has one ray a pixel, then shows sharp outlines.
const float STOPS_FROM_HALF = 0.5;
const float HOLES_ACROSS = 64.0;  // places along an edge

struct SceneHit {
    float distance;  // MISSED: nothing is met
    vec3 normal;     // of any length, against the ray
    int surface;
    int triangle;
    vec2 at;         // shares of its two edges
};

vec4 rayTexel(sampler2D table, int i)
{
    return texelFetch(table, ivec2(i & (RAY_COLUMNS - 1), i / RAY_COLUMNS), 0);
}

// Where a ray enters a box, or MISSED. inverse: of its direction.
float boxEntry(vec3 low, vec3 high, vec3 origin, vec3 inverse, float limit)
{
    vec3 a = (low - origin) * inverse;
    vec3 b = (high - origin) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float from = max(max(near.x, near.y), max(near.z, 0.0));
    float to = min(min(far.x, far.y), min(far.z, limit));
    return from <= to ? from : MISSED;
}

// A number in [0,1) that looks random, of a place in a triangle.
float placeNumber(int triangle, vec2 at)
{
    uint h = uint(triangle) * 0x9E3779B9u ^ uint(at.x * HOLES_ACROSS) * 0x85EBCA6Bu ^ uint(at.y * HOLES_ACROSS) * 0xC2B2AE35u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    return float((h ^ h >> 13) >> 8) / 16777216.0;
}

// [Moeller, Trumbore 1997]. Each triangle is a little larger than it is, so that no ray passes between two that share an edge.
void meetTriangle(sampler2D triangles, int i, vec3 origin, vec3 direction, float stops, inout SceneHit hit)
{
    const float margin = 1e-5;  // of an edge, beyond what single precision loses
    vec4 corner = rayTexel(triangles, TRIANGLE_TEXELS * i);
    vec4 edgeTexel = rayTexel(triangles, TRIANGLE_TEXELS * i + 1);
    vec3 edge = edgeTexel.xyz;
    vec3 otherEdge = rayTexel(triangles, TRIANGLE_TEXELS * i + 2).xyz;
    vec3 p = cross(direction, otherEdge);
    float determinant = dot(edge, p);
    float inverse = 1.0 / (determinant == 0.0 ? 1.0 : determinant);
    vec3 to = origin - corner.xyz;
    float u = dot(to, p) * inverse;
    vec3 q = cross(to, edge);
    float v = dot(direction, q) * inverse;
    float distance = dot(otherEdge, q) * inverse;
    if (determinant == 0.0 || u < -margin || u > 1.0 + margin || v < -margin || u + v > 1.0 + margin) return;
    if (!(distance > 0.0 && distance < hit.distance)) return;
    float opacity = edgeTexel.w;
    if (stops == STOPS_BY_PLACE ? opacity <= placeNumber(i, max(vec2(u, v), vec2(0.0))) : opacity < stops) return;
    hit = SceneHit(distance, cross(edge, otherEdge) * (determinant > 0.0 ? 1.0 : -1.0), int(corner.w), i, vec2(u, v));
}

// The nearest one. direction: of unit length. stops: STOPS_BY_PLACE or STOPS_FROM_HALF.
SceneHit sceneHit(sampler2D nodes, sampler2D triangles, vec3 origin, vec3 direction, float within, float stops)
{
    vec3 inverse = 1.0 / mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    SceneHit hit = SceneHit(within, vec3(0.0), 0, 0, vec2(0.0));
    int waiting[BVH_DEPTH];  // nodes, at most one a level
    int count = 0;
    vec4 root = rayTexel(nodes, 0);
    int at = int(root.w);
    if (boxEntry(root.xyz, rayTexel(nodes, 1).xyz, origin, inverse, within) == MISSED) at = 0;
    while (at != 0) {
        while (at > 0) {
            vec4 first = rayTexel(nodes, 2 * at);
            vec4 second = rayTexel(nodes, 2 * at + 2);
            float a = boxEntry(first.xyz, rayTexel(nodes, 2 * at + 1).xyz, origin, inverse, hit.distance);
            float b = boxEntry(second.xyz, rayTexel(nodes, 2 * at + 3).xyz, origin, inverse, hit.distance);
            bool secondFirst = b < a;
            if (a != MISSED && b != MISSED) waiting[count++] = int(secondFirst ? first.w : second.w);
            if (min(a, b) != MISSED)
                at = int(secondFirst ? second.w : first.w);
            else
                at = count > 0 ? waiting[--count] : 0;
        }
        int next = -at / RAY_LEAF;
        int last = next + (-at & (RAY_LEAF - 1));
        while (next < last) meetTriangle(triangles, next++, origin, direction, stops, hit);
        at = count > 0 ? waiting[--count] : 0;
    }
    if (hit.distance == within) hit.distance = MISSED;
    return hit;
}

// Of unit length, between those of the triangle's corners, on the side that is met.
vec3 smoothNormal(sampler2D triangles, SceneHit hit)
{
    vec3 own = normalize(hit.normal);
    vec4 codes = rayTexel(triangles, TRIANGLE_TEXELS * hit.triangle + 3);
    if (codes.x < 0.0) return own;
    vec3 n = (1.0 - hit.at.x - hit.at.y) * unpackDirection(codes.x) + hit.at.x * unpackDirection(codes.y) +
             hit.at.y * unpackDirection(codes.z);
    return dot(n, n) > 0.0 ? normalize(dot(n, own) < 0.0 ? -n : n) : own;
}

#endif
