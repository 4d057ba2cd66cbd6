// SPDX-License-Identifier: MIT
// The probes about a point [indirect.md 4]: what surfaces send about a direction there, and how much of that direction they fill.
// Positions are about the origin of the probes.
#ifndef PROBEGRID_GLSL
#define PROBEGRID_GLSL

#include "lib/limits.glsl"
#include "lib/octahedral.glsl"

uniform sampler2D probePlaceMap;      // position, and how much the probe counts
uniform sampler2D probeDepthMap;      // distance and its square by direction
uniform sampler2D probeIrradianceMap; // mean radiance of the surfaces, times their share; their share
uniform ivec3 probeCount;
uniform int probeColumns;  // probes side by side in the maps
uniform float probePlanes[3 * MOST_PROBES];  // of their grid, where they cross each axis

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

// The eight probes about a point, and how much each counts there.
struct ProbeCage {
    int probe[8];
    float weight[8];
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

// n: of the surface; v: to the eye, or n.
ProbeCage probesAbout(vec3 point, vec3 n, vec3 v)
{
    ProbeCage cage;
    ProbeCell x = probeCell(0, point.x);
    ProbeCell y = probeCell(1, point.y);
    ProbeCell z = probeCell(2, point.z);
    // Off the surface, which the probes' distances blur.
    vec3 lifted = point + 0.3 * min(x.width, min(y.width, z.width)) * (0.7 * n + 0.3 * v);
    x = probeCell(0, lifted.x);
    y = probeCell(1, lifted.y);
    z = probeCell(2, lifted.z);
    ivec3 first = ivec3(x.first, y.first, z.first);
    vec3 share = vec3(x.share, y.share, z.share);
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        ivec3 at = clamp(first + corner, ivec3(0), probeCount - 1);
        int probe = (at.z * probeCount.y + at.y) * probeCount.x + at.x;
        vec3 linear = mix(1.0 - share, share, vec3(corner));
        vec4 own = texelFetch(probePlaceMap, probeTexel(probe), 0);
        vec3 to = own.xyz - point;
        float facing = 0.5 * dot(to, n) * inversesqrt(max(dot(to, to), 1e-30)) + 0.5;
        float w = max(linear.x * linear.y * linear.z, 1e-4) * (facing * facing + 0.2);
        vec3 from = lifted - own.xyz;
        float distance = length(from);
        w *= probeSees(probe, from / max(distance, 1e-20), distance);
        w = w < 0.2 ? w * w * w / 0.04 : w;  // what hardly counts counts less: no light comes through walls
        cage.probe[k] = probe;
        cage.weight[k] = own.w * w;
    }
    return cage;
}

// What surfaces send about a direction.
struct SentAbout {
    vec3 radiance;  // their mean
    float share;    // of the directions about it that they fill, by the cosine
};

SentAbout sentAbout(ProbeCage cage, vec3 d)
{
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int k = 0; k < 8; ++k) {
        if (cage.weight[k] <= 0.0) continue;
        sum += cage.weight[k] * probeLookup(probeIrradianceMap, cage.probe[k], float(PROBE_IRRADIANCE_SIDE), d);
        weights += cage.weight[k];
    }
    // The mean of what fills a twentieth and more; less is dimmed, as the probes may miss it.
    return SentAbout(sum.rgb / max(max(sum.a, 0.05 * weights), 1e-20), sum.a / max(weights, 1e-20));
}

// The radiance that a white surface sends on of what others send to it. hidden: the share of directions in which it does not see the map.
// That decides how much it is; the probes, which lie beside the surface, say of what colour.
vec3 receivedFrom(SentAbout sent, float hidden)
{
    return min(4.0 * max(sent.share, 0.05), hidden) * sent.radiance;
}

#endif
