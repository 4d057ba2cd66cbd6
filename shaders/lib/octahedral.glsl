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

// Corner of a level's bordered square in the atlas, in texels: level 0 at the left, the others stacked right of it.
// The sum of their sides (s + 2 each) is S (1 - 2^(1-level)) + 2 (level - 1).
vec2 pyramidLevelCorner(float baseSide, float level)
{
    if (level < 0.5) return vec2(0.0);
    return vec2(baseSide + 2.0, baseSide * (1.0 - exp2(1.0 - level)) + 2.0 * (level - 1.0));
}

// One level of the pyramid in direction d, bilinear.
vec3 pyramidLevel(sampler2D atlas, float baseSide, vec3 d, float level)
{
    vec2 texel = pyramidLevelCorner(baseSide, level) + 1.0 +
                 octahedralFromDirection(d) * pyramidLevelSide(baseSide, level);
    return vec3(textureLod(atlas, texel / vec2(textureSize(atlas, 0)), 0.0));
}

// The pyramid in direction d at a real lod, trilinear, between level 0 and lastLevel.
vec3 pyramidLookup(sampler2D atlas, float baseSide, float lastLevel, vec3 d, float lod)
{
    float l = clamp(lod, 0.0, lastLevel);
    float l0 = min(floor(l), max(lastLevel - 1.0, 0.0));
    vec3 a = pyramidLevel(atlas, baseSide, d, l0);
    if (lastLevel < 0.5) return a;
    return mix(a, pyramidLevel(atlas, baseSide, d, l0 + 1.0), l - l0);
}

#endif
