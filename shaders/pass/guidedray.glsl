// SPDX-License-Identifier: MIT
// The next ray of a path from a Lambert layer. Small bright places may send much light, but few cosine-weighted rays find them. Some rays
// are therefore aimed at such places, and the others are cosine-weighted [one-sample multiple importance sampling: Veach 1997, 9.2.4].
// A probe close by says which places send light here. If it is wrong, there is more noise; the mean over the rays stays right.
#ifndef GUIDEDRAY_GLSL
#define GUIDEDRAY_GLSL

#include "lib/guide.glsl"
#include "lib/limits.glsl"
#include "lib/phong.glsl"
#include "pass/probegrid.glsl"

uniform usampler2D guideMap;  // of pass/guides.frag

struct GuidedRay {
    vec3 along;
    float weight;  // what it counts in a mean of radiance that a white surface would send on
};

const float MOST_GUIDED = 0.75;  // share of rays

struct Guides {
    vec4 sphere[GUIDES];   // centre, from the ray's origin, and radius
    float weight[GUIDES];  // 0: nothing comes from there
    float sum;             // of the weights
    float rest;            // comes from elsewhere
};

// The probe at one of the corners of the place's cell, the nearer the likelier. u: in [0,1).
int probeBeside(vec3 place, vec3 n, float u)
{
    ProbeCube cube = cubeOf(0, place + 0.3 * cubeOf(0, place).least * n);
    vec3 chance = fract(u * vec3(1.0, 256.0, 65536.0));
    ivec3 corner = ivec3(lessThan(chance, cube.share));
    return probeAt(min(cube.first + corner, probeCount - 1));
}

Guides guidesAbout(int probe, vec3 place, vec3 n)
{
    Guides g;
    g.sum = 0.0;
    g.rest = 1.0;
    uvec4 codes = texelFetch(guideMap, probeTexel(probe), 0);
    vec3 toProbe = texelFetch(probePlaceMap, probeTexel(probe), 0).xyz - place;
    int side = textureSize(guideMap, 0).x;
    for (int k = 0; k < GUIDES; ++k) {
        uint code = codes[k / 2] >> uint(16 * (k & 1)) & 0xffffu;
        float seen = guideShare(code);
        g.weight[k] = 0.0;
        if (seen <= 0.0) continue;
        g.rest -= seen;
        int number = guideNumber(code);
        vec4 sphere = uintBitsToFloat(texelFetch(guideMap, ivec2(number % side, probeColumns + number / side), 0));
        g.sphere[k] = vec4(sphere.xyz - place, sphere.w);
        g.weight[k] = guideWeight(g.sphere[k].xyz, sphere.w, n, seen, toProbe - g.sphere[k].xyz);
        g.sum += g.weight[k];
    }
    return g;
}

// n: of unit length; u: in [0,1)^2; v: in [0,1).
GuidedRay guidedRay(vec3 place, vec3 n, vec2 u, float v)
{
    Guides g = guidesAbout(probeBeside(place, n, v), place, n);
    float share = g.sum > 0.0 ? MOST_GUIDED * g.sum / (g.sum + max(g.rest, 0.0)) : 0.0;
    vec3 along;
    if (u.x < share) {
        float rest = u.x / share * g.sum;
        int chosen = -1;  // of those that weigh anything, whatever rounding leaves
        for (int k = 0; k < GUIDES && (chosen < 0 || rest >= g.weight[chosen]); ++k) {
            if (g.weight[k] <= 0.0) continue;
            if (chosen >= 0) rest -= g.weight[chosen];
            chosen = k;
        }
        along = guideDirection(g.sphere[chosen].xyz, g.sphere[chosen].w, vec2(min(rest / g.weight[chosen], 1.0), u.y));
    } else {
        along = frameAround(n) * phongSample(1.0, vec2((u.x - share) / (1.0 - share), u.y));
    }
    float lambert = INV_PI * max(dot(along, n), 0.0);
    float density = (1.0 - share) * lambert;
    for (int k = 0; k < GUIDES; ++k)
        if (g.weight[k] > 0.0) density += share * g.weight[k] / g.sum * guideDensity(g.sphere[k].xyz, g.sphere[k].w, along);
    return GuidedRay(along, density > 0.0 ? lambert / density : 0.0);
}

#endif
