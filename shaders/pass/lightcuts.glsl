// SPDX-License-Identifier: MIT
// A tree of clusters of the area lights, about the emitter points' origin. A walk goes down the tree. It stops at a cluster, and takes it
// for its lights, where the difference is no more than a share of what the receiver gets of all lights.
#ifndef PASS_LIGHTCUTS_GLSL
#define PASS_LIGHTCUTS_GLSL
#pragma import_defines(HAS_CHOSEN_POINTS)

#include "lib/farlight.glsl"
#include "lib/lightcut.glsl"
#include "lib/limits.glsl"
#include "lib/octahedral.glsl"

uniform sampler2D lightTreeMap; // CLUSTER_ROWS texels above each other are a cluster: place, number of the one after it and all that is in
                                // it, or of a leaf -1 - 2 times its light's number, 1 less of the light's back; reach, spread; power, axis
uniform float lightCutError;
#ifdef HAS_CHOSEN_POINTS
uniform sampler2D lightsWithPointsMap;  // by leaf: 1 if points of it have shadow maps
#endif
// The share of light from there that the diffuse layer sends to the eye. Who includes this defines it.
vec3 diffuseShare(vec3 toLight);

// Shadows of other lights do not dim a light that has no points and sends much of all light: mostly it is near. This begins at the first
// share and is complete at the second. Pictures from above a city differ from the truth by .0114, .0113, .0116 (mean) with .05 to .2,
// .1 to .3 and .2 to .6, and by .021 without this.
const float SOME = 0.1;
const float MUCH = 0.3;
// No light.
const int NO_LEAF = -1;

struct LightNode {
    LightCluster cluster;
    vec3 power;  // in colours
    int next;
    int leaf;  // twice its light's number, 1 more for the light's back; NO_LEAF
};

vec4 clusterTexel(int i, int row)
{
    return texelFetch(lightTreeMap, ivec2(i % LIGHT_COLUMNS, i / LIGHT_COLUMNS * CLUSTER_ROWS + row), 0);
}

LightNode lightNode(int i, vec3 point)
{
    LightNode node;
    vec4 place = clusterTexel(i, 0);
    vec4 reach = clusterTexel(i, 1);
    vec4 power = clusterTexel(i, 2);
    node.cluster.place = place.xyz - point;
    node.cluster.reach = reach.xyz;
    node.cluster.axis = unpackDirection(power.w);
    node.cluster.spread = reach.w;
    node.cluster.power = dot(power.rgb, vec3(1.0 / 3.0));
    node.power = power.rgb;
    int code = int(place.w);
    node.next = code < 0 ? i + 1 : code;
    node.leaf = max(-1 - code, NO_LEAF);
    return node;
}

struct LightWalk {
    int at;       // the next cluster
    int end;
    float total;  // of what all lights send, about
    bool isDiffuse;
    vec3 sent;    // by those that it took
    vec3 alone;   // of this by lights that it sees, as far as one knows
    int leaf;     // that is too near to be taken as a point; NO_LEAF: the walk is at its end
};

// How many clusters there are: the first holds all.
int lightTreeEnd()
{
    float code = clusterTexel(0, 0).w;
    return code < 0.0 ? 1 : int(code);
}

// What all lights send, roughly; mean of the colours. A cluster stands for its lights if it is no larger than it is far. Near lights count
// as if they were blurred.
float roughlySent(vec3 point, LightReceiver r, int end)
{
    float sum = 0.0;
    int at = 0;
    while (at < end) {
        LightNode node = lightNode(at, point);
        float size = dot(node.cluster.reach, node.cluster.reach);
        bool taken = node.leaf != NO_LEAF || size <= dot(node.cluster.place, node.cluster.place);
        if (taken) sum += node.cluster.power * clusterKernel(r, node.cluster, size);
        at = taken ? node.next : at + 1;
    }
    return sum;
}

// What the diffuse layer of a surface of unit normal n is.
LightReceiver diffuseReceiver(vec3 n)
{
    return LightReceiver(n, n, mat3(1.0), INV_PI);
}

// total: of what all lights send, about
LightWalk beginWalk(float total, bool isDiffuse)
{
    return LightWalk(0, lightTreeEnd(), total, isDiffuse, vec3(0.0), vec3(0.0), NO_LEAF);
}

// From 0 to 1, how much a light is such a one.
float loneness(LightWalk w, int leaf, vec3 sent)
{
#ifdef HAS_CHOSEN_POINTS
    if (leaf == NO_LEAF || texelFetch(lightsWithPointsMap, ivec2(leaf % LIGHT_COLUMNS, leaf / LIGHT_COLUMNS), 0).r > 0.0) return 0.0;
    return smoothstep(SOME, MUCH, dot(sent, vec3(1.0 / 3.0)) / max(w.total, 1e-30));
#else
    return 0.0;
#endif
}

LightWalk withSent(LightWalk w, int leaf, vec3 sent, vec3 share)
{
    w.sent += sent * share;
    w.alone += sent * share * loneness(w, leaf, sent);
    return w;
}

// What arrives of it, by the share that the surface sees of what the points send.
vec3 arriving(LightWalk w, vec3 seen)
{
    return seen * (w.sent - w.alone) + w.alone;
}

// On to the next light that is too near, or to the end.
LightWalk walkOn(LightWalk w, vec3 point, LightReceiver r)
{
    w.leaf = NO_LEAF;
    while (w.at < w.end && w.leaf == NO_LEAF) {
        LightNode node = lightNode(w.at, point);
        float kernel = clusterKernel(r, node.cluster, 0.0);
        bool taken = clusterError(clusterRange(r, node.cluster), node.cluster.power * kernel) <= lightCutError * w.total;
        vec3 reach = node.cluster.reach;
        bool isPoint = node.leaf != NO_LEAF && isFarLight(node.cluster.place, dot(reach, reach), r.n);
        if (w.isDiffuse) taken = taken || isPoint;
        vec3 share = w.isDiffuse ? diffuseShare(node.cluster.place) : vec3(1.0);
        if (taken)
            w = withSent(w, node.leaf, node.power * kernel, share);
        else
            w.leaf = node.leaf;
        w.at = taken || node.leaf != NO_LEAF ? node.next : w.at + 1;
    }
    return w;
}

#endif
