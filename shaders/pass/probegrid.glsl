// SPDX-License-Identifier: MIT
// The probes about a point [indirect.md 4]: what surfaces send about a direction there, and how much of that direction they fill.
// Positions are about the origin of the probes.
#ifndef PROBEGRID_GLSL
#define PROBEGRID_GLSL
#pragma import_defines(HAS_PROBE_LATTICES)

#include "lib/limits.glsl"
#include "lib/octahedral.glsl"

uniform sampler2D probePlaceMap;      // position, and how much the probe counts
uniform sampler2D probeDepthMap;      // distance and its square by direction
uniform sampler2D probeIrradianceMap; // mean radiance of the surfaces, times their share; their share
uniform ivec3 probeCount;  // of each of their grids
uniform int probeColumns;  // probes side by side in the maps
uniform float probePlanes[3 * MOST_PROBES];  // of the grid of all the scene, where they cross each axis
#ifdef HAS_PROBE_LATTICES
uniform vec4 probeLattices[PROBE_LATTICES];  // of the finer grids, whose probes follow: the first probe's place; side of a cell
uniform vec3 probeLatticeBounds[2 * PROBE_LATTICES];  // in cells from there, low and high; far away where the scene ends before
#endif

ivec2 probeTexel(int probe)
{
    return ivec2(probe % probeColumns, probe / probeColumns);
}

// One of the octahedral maps that lie side by side, each with a border of one texel.
vec4 probeLookup(sampler2D maps, int probe, float side, vec3 d)
{
    vec2 corner = vec2(probeTexel(probe)) * (side + 2.0) + 1.0;
    return textureLod(maps, (corner + octahedralFromDirection(d) * side) / vec2(textureSize(maps, 0)), 0.0);
}

// The eight probes of a grid about a point, and how much each counts there.
struct ProbeCage {
    int probe[8];
    float weight[8];
};

struct ProbesAbout {
    ProbeCage cage;
#ifdef HAS_PROBE_LATTICES
    ProbeCage coarser;  // of the next grid
    int cages;          // 2 if that counts, too
#endif
};

// From what a probe knows of its distances that way: 1 for what lies before them, less behind them [Donnelly, Lauritzen 2006].
float probeSees(int probe, vec3 to, float distance)
{
    vec2 depth = probeLookup(probeDepthMap, probe, float(PROBE_DEPTH_SIDE), to).rg;
    if (distance <= depth.x) return 1.0;
    float variance = abs(depth.y - depth.x * depth.x);
    float beyond = distance - depth.x;
    float bound = variance / (variance + beyond * beyond);
    return max(bound * bound * bound, 0.03);
}

// The cell along an axis that a place lies in: the plane before it, the share of the way to the next, and how far that is.
struct ProbeCell {
    int first;
    float share;
    float width;
};

ProbeCell probeCell(int axis, float place)
{
    int planes = axis * MOST_PROBES;
    int last = probeCount[axis] - 1;
    int first = 0;
    for (int i = 1; i < last; ++i) first += place >= probePlanes[planes + i] ? 1 : 0;
    float low = probePlanes[planes + first];
    float width = probePlanes[planes + min(first + 1, last)] - low;
    return ProbeCell(first, width > 0.0 ? clamp((place - low) / width, 0.0, 1.0) : 0.0, width);
}

// The cell of a grid that a point lies in.
struct ProbeCube {
    ivec3 first;
    vec3 share;
    float least;  // of its sides
};

ProbeCube cubeOfScene(vec3 p)
{
    ProbeCell x = probeCell(0, p.x);
    ProbeCell y = probeCell(1, p.y);
    ProbeCell z = probeCell(2, p.z);
    return ProbeCube(ivec3(x.first, y.first, z.first), vec3(x.share, y.share, z.share), min(x.width, min(y.width, z.width)));
}

int probeAt(ivec3 at)
{
    return (at.z * probeCount.y + at.y) * probeCount.x + at.x;
}

// lifted: the point, moved off its surface. A probe in or behind the surface's plane may stand at the dark side of a body. Beside other
// probes that see the point it counts little.
float probeWeight(int probe, vec3 linear, vec3 point, vec3 lifted, vec3 n)
{
    vec4 own = texelFetch(probePlaceMap, probeTexel(probe), 0);
    vec3 to = own.xyz - point;
    float cosine = dot(to, n) * inversesqrt(max(dot(to, to), 1e-30));
    float facing = 0.5 * cosine + 0.5;
    float w = facing * facing * smoothstep(-0.1, 0.2, cosine) + 0.02;
    vec3 from = lifted - own.xyz;
    float distance = length(from);
    w *= probeSees(probe, from / max(distance, 1e-20), distance);
    w = w < 0.2 ? w * w * w / 0.04 : w;  // what hardly counts counts less: no light comes through walls
    return own.w * w * max(linear.x * linear.y * linear.z, 1e-4);
}

#ifdef HAS_PROBE_LATTICES
vec3 latticePlace(int lattice, vec3 p)
{
    return (p - probeLattices[lattice].xyz) / probeLattices[lattice].w;
}

// 1 within a lattice, 0 beyond it, and over its outer cells what is between.
float latticeShare(int lattice, vec3 p)
{
    vec3 place = latticePlace(lattice, p);
    vec3 inside = min(place - probeLatticeBounds[2 * lattice], probeLatticeBounds[2 * lattice + 1] - place);
    return clamp(min(inside.x, min(inside.y, inside.z)), 0.0, 1.0);
}

ProbeCube cubeOfLattice(int lattice, vec3 p)
{
    vec3 place = clamp(latticePlace(lattice, p), vec3(0.0), vec3(probeCount - 1));
    ivec3 first = min(ivec3(place), max(probeCount - 2, ivec3(0)));
    return ProbeCube(first, place - vec3(first), probeLattices[lattice].w);
}

#endif

// grid: 0 of all the scene, then the lattices.
ProbeCube cubeOf(int grid, vec3 p)
{
#ifdef HAS_PROBE_LATTICES
    if (grid > 0) return cubeOfLattice(grid - 1, p);
#endif
    return cubeOfScene(p);
}

// n: of the surface; v: to the eye, or n.
ProbeCage cageOf(int grid, vec3 point, vec3 n, vec3 v)
{
    ProbeCage cage;
    // Off the surface, which the probes' distances blur.
    vec3 lifted = point + 0.3 * cubeOf(grid, point).least * (0.7 * n + 0.3 * v);
    ProbeCube cube = cubeOf(grid, lifted);
    int first = grid * probeCount.x * probeCount.y * probeCount.z;
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        cage.probe[k] = first + probeAt(min(cube.first + corner, probeCount - 1));
        cage.weight[k] = probeWeight(cage.probe[k], mix(1.0 - cube.share, cube.share, vec3(corner)), point, lifted, n);
    }
    return cage;
}

#ifdef HAS_PROBE_LATTICES
// The cage of the finest grid that reaches the point. The next coarser grid's cage is added at the border of the finest one and
// where none of its probes sees the point. Only there does the loop make a second turn.
ProbesAbout probesAbout(vec3 point, vec3 n, vec3 v)
{
    int grid = 0;
    float share = 1.0;
    for (int i = 0; i < PROBE_LATTICES; ++i) {
        float own = latticeShare(i, point);
        grid = own > 0.0 ? i + 1 : grid;
        share = own > 0.0 ? own : share;
    }
    ProbesAbout about;
    about.cages = 0;
    float rest = 1.0;
    do {
        ProbeCage cage = cageOf(grid, point, n, v);
        float all = 1e-4;
        for (int k = 0; k < 8; ++k) all += cage.weight[k];
        float given = about.cages == 0 ? share : rest;
        for (int k = 0; k < 8; ++k) cage.weight[k] *= given / all;
        rest -= given * (1.0 - 1e-4 / all);
        if (about.cages == 0)
            about.cage = cage;
        else
            about.coarser = cage;
        ++about.cages;
        grid = max(grid - 1, 0);
    } while (about.cages < 2 && rest > 2e-3);
    return about;
}
#else
ProbesAbout probesAbout(vec3 point, vec3 n, vec3 v)
{
    return ProbesAbout(cageOf(0, point, n, v));
}
#endif

// What surfaces send about a direction.
struct SentAbout {
    vec3 radiance;  // their mean
    float share;    // of the directions about it that they fill, by the cosine
};

void addSent(ProbeCage cage, vec3 d, inout vec4 sum, inout float weights)
{
    for (int k = 0; k < 8; ++k) {
        if (cage.weight[k] <= 0.0) continue;
        sum += cage.weight[k] * probeLookup(probeIrradianceMap, cage.probe[k], float(PROBE_IRRADIANCE_SIDE), d);
        weights += cage.weight[k];
    }
}

SentAbout sentAbout(ProbesAbout about, vec3 d)
{
    vec4 sum = vec4(0.0);
    float weights = 0.0;
#ifdef HAS_PROBE_LATTICES
    int i = 0;
    do {
        ProbeCage cage = about.cage;
        if (i > 0) cage = about.coarser;
        addSent(cage, d, sum, weights);
    } while (++i < about.cages);
#else
    addSent(about.cage, d, sum, weights);
#endif
    // The mean of what fills a twentieth and more; less is dimmed, as the probes may miss it.
    return SentAbout(sum.rgb / max(max(sum.a, 0.05 * weights), 1e-20), sum.a / max(weights, 1e-20));
}

// The share of directions from which other surfaces send light to a surface. hidden: the share in which the surface does not see the map.
// This share decides how much light the surface receives. The probes, which lie beside the surface, decide its colour.
float sendingShare(SentAbout sent, float hidden)
{
    return min(4.0 * max(sent.share, 0.05), hidden);
}

// The radiance that a white surface sends on of what others send to it.
vec3 receivedFrom(SentAbout sent, float hidden)
{
    return sendingShare(sent, hidden) * sent.radiance;
}

#endif
