// SPDX-License-Identifier: MIT
// The shadow map of a point of a light. It shows a square window at distance 1 along its axis. Heights are the nearest distance that
// counts over the distance along the axis, so planes are planes in the map, as in lib/atlas.glsl [area-lights.md 3, "The sun's tracer"].
// Positions are in texels.
#ifndef EMITTERMAP_GLSL
#define EMITTERMAP_GLSL

#include "lib/atlas.glsl"

// Half the width of the widest window [area-lights.md 3: wider ones have coarser texels and err more].
const float EMITTER_MAP_TANGENT = 2.0;
// The nearest distance that counts, in shares of the extent of all that casts shadows.
const float EMITTER_MAP_NEAR = 1e-3;
// Shadows are told apart from this on, in texels' widths, if 16 bits tell heights apart so finely.
const float EMITTER_MAP_STEP = 0.0128;

struct EmitterMap {
    vec2 window;    // its centre
    float tangent;  // half its width; 0: the map is not drawn yet
    float nearest;
    float octaves;  // from the nearest distance to the farthest, by powers of two
    ivec2 corner;   // in the texture
    int size;
};

// Width of a texel at distance 1.
float emitterTexelWidth(EmitterMap m)
{
    return 2.0 * m.tangent / float(m.size);
}

// A height as 16 bits keep it, as exact in relation to its size at any distance; 0 for none.
float packedHeight(float height, float octaves)
{
    return height > 0.0 ? clamp(1.0 + log2(height) / octaves, 0.0, 1.0) : 0.0;
}

float unpackedHeight(float code, float octaves)
{
    return code > 0.0 ? exp2((code - 1.0) * octaves) : 0.0;
}

// What a texel keeps of its two surfaces: the height between them, and how the first rises in relation to its height. slope, turn, back:
// as in skyHeight(). width: of a texel at distance 1.
vec2 emitterTexel(float firstDepth, float secondDepth, vec3 slope, float width, float octaves)
{
    float first = 1.0 - firstDepth;
    float middle = skyHeight(firstDepth, secondDepth, slope.x, slope.y, first * width);
    return vec2(packedHeight(middle, octaves), packedRise(abs(slope.x) / max(first, 1e-20), slope.z));
}

// The least share of a height by which two are told apart.
float emitterMapStep(EmitterMap m)
{
    return max(EMITTER_MAP_STEP * emitterTexelWidth(m), m.octaves * (0.6931472 / 65535.0));
}

// Where a map shows a point at (x, y, z) of its axes: position and height; height 0 for what is beside or behind it.
vec3 emitterMapPlace(EmitterMap m, vec3 p)
{
    if (p.z <= 0.0) return vec3(0.0);
    vec2 st = (vec2(p.x, p.y) / p.z - m.window) / m.tangent;
    if (max(abs(st.x), abs(st.y)) >= 1.0) return vec3(0.0);
    return vec3((0.5 * st + 0.5) * float(m.size), m.nearest / p.z);
}

// How much the plane of normal n through p rises over so many texels, in shares of the height at p. Both are along the map's axes.
float emitterMapRise(EmitterMap m, vec3 p, vec3 n, vec2 texels)
{
    float away = dot(n, p);
    vec2 gradient = vec2(n.x, n.y) * (emitterTexelWidth(m) * p.z);
    return away < 0.0 ? dot(gradient, texels) / away : 0.0;
}

// The face of a cube about the origin that direction d meets: +x, -x, +y, -y, +z, -z.
int cubeFace(vec3 d)
{
    vec3 a = abs(d);
    if (a.x >= max(a.y, a.z)) return d.x > 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y > 0.0 ? 2 : 3;
    return d.z > 0.0 ? 4 : 5;
}

// Weight of a texel beside (-1, 1) and about (0) a point that lies d texels off its centre: a quadratic B-spline.
float splineWeight(int side, float d)
{
    float near = 0.5 + float(side) * d;
    return side == 0 ? 0.75 - d * d : 0.5 * near * near;
}

// 0 if the texel hides the light from the point at place, else 1. It hides the point only if two things hold, or the foot of a wall would be
// dark, where the wall's plane goes on below the floor: the texel is above the point's plane, and the texel's plane is above the point.
// That plane may fall by two texels' widths. rise: of the point's plane to the texel's centre, in shares of the point's height.
float emitterTexelPasses(vec4 texel, EmitterMap m, vec2 centre, vec3 place, float rise)
{
    float middle = unpackedHeight(texel.x, m.octaves) / place.z;
    float least = emitterMapStep(m);
    if (middle <= 1.0 + max(rise, -0.9) + least) return 1.0;
    float width = emitterTexelWidth(m);
    float fall = dot(unpackedRise(texel.y), vec2(place.x, place.y) - centre) * middle;
    return middle + clamp(fall, -2.0 * width, 2.0 * width) > 1.0 + 0.1 * width + least ? 0.0 : 1.0;
}

// The same for texel t of the map, or the nearest one within it. n: of the surface at p.
float emitterTexelAtPasses(sampler2D maps, EmitterMap m, vec3 p, vec3 n, vec3 place, ivec2 t)
{
    ivec2 at = clamp(t, ivec2(0), ivec2(m.size - 1));
    vec2 centre = vec2(at) + 0.5;
    float rise = emitterMapRise(m, p, n, centre - vec2(place.x, place.y));
    return emitterTexelPasses(texelFetch(maps, m.corner + at, 0), m, centre, place, rise);
}

// The share of a light without size that reaches the surface of normal n at p, which the map shows at place. It is a weighted mean over 3 x 3
// texels, so a shadow's edge is three texels wide.
float emitterMapShare(sampler2D maps, EmitterMap m, vec3 p, vec3 n, vec3 place)
{
    vec2 xy = vec2(place.x, place.y);
    ivec2 middle = ivec2(xy);
    vec2 d = fract(xy) - 0.5;
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            float passes = emitterTexelAtPasses(maps, m, p, n, place, middle + ivec2(x, y));
            sum += splineWeight(x, d.x) * splineWeight(y, d.y) * passes;
        }
    return sum;
}

// The same, interpolated linearly between the centres of 2 x 2 texels: for a light of many points, whose shadows' edges overlap.
float emitterMapLinearShare(sampler2D maps, EmitterMap m, vec3 p, vec3 n, vec3 place)
{
    vec2 xy = vec2(place.x, place.y);
    vec2 first = floor(xy - 0.5);
    vec2 part = xy - 0.5 - first;
    float sum = 0.0;
    for (int y = 0; y <= 1; ++y)
        for (int x = 0; x <= 1; ++x) {
            float passes = emitterTexelAtPasses(maps, m, p, n, place, ivec2(first) + ivec2(x, y));
            sum += (x == 0 ? 1.0 - part.x : part.x) * (y == 0 ? 1.0 - part.y : part.y) * passes;
        }
    return sum;
}

#endif
