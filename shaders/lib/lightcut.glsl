// SPDX-License-Identifier: MIT
// Clusters of area lights, each taken as a point: what it sends into a lobe, and a bound of the error [Walter et al. 2005, "Lightcuts:
// A Scalable Approach to Illumination", 4]. A lobe is a cosine lobe that a matrix stretches [lib/ltc.glsl]. The diffuse layer has a cosine
// lobe that is not stretched. All directions are in one frame.
#ifndef LIGHTCUT_GLSL
#define LIGHTCUT_GLSL

#include "lib/constants.glsl"

struct LightCluster {
    vec3 place;    // mean of its lights' places by power, from the receiver
    vec3 reach;    // half of the sides of a box about it that holds them
    vec3 axis;     // unit: mean of their normals by power
    float spread;  // most that a normal differs from it; of spheres, negative
    float power;   // radiance times area as if all faced along the axis, mean of the colours; of spheres, of a quarter of the area
};

struct LightReceiver {
    vec3 n;       // unit normal: nothing arrives from below
    vec3 up;      // its product with a place is that place's height above the cosine lobe's horizon
    mat3 lobe;    // columns: their products with a place are it in the cosine lobe's space
    float scale;  // the lobe's density where both spaces are the same
};

struct LightRange {
    float least;
    float most;
};

// Of the products of g and the places in the cluster's box.
LightRange rangeAlong(LightCluster c, vec3 g)
{
    float middle = dot(g, c.place);
    float reach = dot(abs(g), c.reach);
    LightRange r;
    r.least = middle - reach;
    r.most = middle + reach;
    return r;
}

// Of the squared distances to places in the box, in a space to which the columns lead.
LightRange squareRange(LightCluster c, mat3 columns)
{
    LightRange square;
    square.least = 0.0;
    square.most = 0.0;
    for (int i = 0; i < 3; ++i) {
        float middle = abs(dot(columns[i], c.place));
        float reach = dot(abs(columns[i]), c.reach);
        float nearest = max(middle - reach, 0.0);
        square.least += nearest * nearest;
        square.most += (middle + reach) * (middle + reach);
    }
    return square;
}

// What lights of power 1 at the cluster's place send: the share of the lobe that they cover, over their area.
// softness: added to the squared distance, which keeps it finite close by
float clusterKernel(LightReceiver r, LightCluster c, float softness)
{
    vec3 place = c.place * r.lobe;
    float square = max(dot(place, place) + softness, 1e-15);
    float facing = c.spread < 0.0 ? length(c.place) : max(-dot(c.axis, c.place), 0.0);
    if (dot(r.n, c.place) <= 0.0) return 0.0;
    return r.scale * max(dot(r.up, c.place), 0.0) * facing / (square * square);
}

// Bounds of what its lights send, mean of the colours: each factor has its extremes somewhere in the box.
LightRange clusterRange(LightReceiver r, LightCluster c)
{
    LightRange above = rangeAlong(c, r.n);
    LightRange height = rangeAlong(c, r.up);
    LightRange square = squareRange(c, r.lobe);
    LightRange distance = squareRange(c, mat3(1.0));
    LightRange facing = rangeAlong(c, -c.axis);
    distance.least = sqrt(distance.least);
    distance.most = sqrt(distance.most);
    float power = c.power;
    if (c.spread < 0.0) {
        facing = distance;
    } else {
        // Normals that differ so from the axis go along it by 1 - spread^2 / 2 at least.
        power *= 1.0 + c.spread * c.spread;
        facing.most = min(facing.most + c.spread * distance.most, distance.most);
        facing.least -= c.spread * distance.most;
    }
    LightRange sent;
    float nearest = max(square.least, 1e-15);
    float farthest = max(square.most, 1e-15);
    sent.most = above.most <= 0.0 ? 0.0 : r.scale * power * max(height.most, 0.0) * max(facing.most, 0.0) / (nearest * nearest);
    sent.least = above.least <= 0.0 ? 0.0 : r.scale * c.power * max(height.least, 0.0) * max(facing.least, 0.0) / (farthest * farthest);
    return sent;
}

// Most by which `sends`, which stands for what the cluster's lights send, may differ from that.
float clusterError(LightRange range, float sends)
{
    return max(range.most - sends, sends - range.least);
}

#endif
