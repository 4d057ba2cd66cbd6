// SPDX-License-Identifier: MIT
// The octahedral map of the sphere onto the unit square, +Z in the middle [Engelhardt, Dachsbacher 2008], and the
// atlas in which the levels of an octahedral pyramid lie side by side, each with a border of one texel, so that the
// hardware's bilinear filter is right across the folded edges.
#ifndef OCTAHEDRAL_GLSL
#define OCTAHEDRAL_GLSL

#include "lib/constants.glsl"

// Square coordinates in [0,1]^2 of direction d (any length > 0).
vec2 octahedralFromDirection(vec3 d)
{
    float s = abs(d.x) + abs(d.y) + abs(d.z);
    vec2 p = vec2(d) / s;
    if (d.z < 0.0) p = vec2((1.0 - abs(p.y)) * (p.x < 0.0 ? -1.0 : 1.0), (1.0 - abs(p.x)) * (p.y < 0.0 ? -1.0 : 1.0));
    return 0.5 * p + 0.5;
}

// Unit direction at square coordinates st in [0,1]^2.
vec3 directionFromOctahedral(vec2 st)
{
    vec2 p = 2.0 * st - 1.0;
    float z = 1.0 - abs(p.x) - abs(p.y);
    if (z < 0.0) p = vec2((1.0 - abs(p.y)) * (p.x < 0.0 ? -1.0 : 1.0), (1.0 - abs(p.x)) * (p.y < 0.0 ? -1.0 : 1.0));
    return normalize(vec3(p, z));
}

// A direction as a whole number below 2^24, which a float holds exactly, to .06 degrees; the axes are exact.
float packDirection(vec3 d)
{
    vec2 st = floor(octahedralFromDirection(d) * 4094.0 + 0.5);
    return st.x * 4096.0 + st.y;
}

vec3 unpackDirection(float code)
{
    float x = floor(code / 4096.0);
    return directionFromOctahedral(vec2(x, code - 4096.0 * x) / 4094.0);
}

// Solid angle [sr] per unit area of the square at st: 4 / |q|^3, q the point of the octahedron |x|+|y|+|z| = 1.
float octahedralSolidAngleDensity(vec2 st)
{
    vec2 p = 2.0 * st - 1.0;
    float z = 1.0 - abs(p.x) - abs(p.y);
    if (z < 0.0) p = vec2(1.0 - abs(p.y), 1.0 - abs(p.x));
    float q2 = dot(p, p) + z * z;
    return 4.0 / (q2 * sqrt(q2));
}

// An octahedral map with a border of one texel, bilinear.
vec3 octahedralLookup(sampler2D map, vec3 d)
{
    float size = float(textureSize(map, 0).x);
    return vec3(textureLod(map, (octahedralFromDirection(d) * (size - 2.0) + 1.0) / size, 0.0));
}

// Side of a pyramid's level, the base having side baseSide (a power of two).
float pyramidLevelSide(float baseSide, float level)
{
    return baseSide * exp2(-level);
}

// Corner of a level's bordered square in the atlas, in texels. Level 0 is at the left, the others are stacked right of it. side: of
// the level. The sum of their sides (s + 2 each) is S (1 - 2^(1-level)) + 2 (level - 1).
vec2 pyramidCorner(float baseSide, float side, float level)
{
    if (level < 0.5) return vec2(0.0);
    return vec2(baseSide + 2.0, baseSide - 2.0 * side + 2.0 * (level - 1.0));
}

vec2 pyramidLevelCorner(float baseSide, float level)
{
    return pyramidCorner(baseSide, pyramidLevelSide(baseSide, level), level);
}

// The texel of a map of that side that its border shows at p, a texel outside at most: over an edge the square goes on mirrored.
ivec2 foldedTexel(ivec2 p, int side)
{
    ivec2 q = p;
    if (q.x < 0 || q.x >= side) q = ivec2(q.x < 0 ? 0 : side - 1, side - 1 - q.y);
    if (q.y < 0 || q.y >= side) q = ivec2(side - 1 - q.x, q.y < 0 ? 0 : side - 1);
    return q;
}

// One level of the pyramid at square coordinates st, bilinear.
vec3 pyramidTexel(sampler2D atlas, vec2 corner, float side, vec2 st)
{
    return vec3(textureLod(atlas, (corner + 1.0 + st * side) / vec2(textureSize(atlas, 0)), 0.0));
}

// The same in direction d.
vec3 pyramidLevel(sampler2D atlas, float baseSide, vec3 d, float level)
{
    return pyramidTexel(atlas, pyramidLevelCorner(baseSide, level), pyramidLevelSide(baseSide, level), octahedralFromDirection(d));
}

// The pyramid in direction d at a real lod, trilinear, between level 0 and lastLevel.
vec3 pyramidLookup(sampler2D atlas, float baseSide, float lastLevel, vec3 d, float lod)
{
    float l = clamp(lod, 0.0, lastLevel);
    float l0 = min(floor(l), max(lastLevel - 1.0, 0.0));
    float side = pyramidLevelSide(baseSide, l0);
    vec2 st = octahedralFromDirection(d);
    vec3 a = pyramidTexel(atlas, pyramidCorner(baseSide, side, l0), side, st);
    if (lastLevel < 0.5) return a;
    float next = 0.5 * side;
    return mix(a, pyramidTexel(atlas, pyramidCorner(baseSide, next, l0 + 1.0), next, st), l - l0);
}

#endif
