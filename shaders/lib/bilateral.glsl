// SPDX-License-Identifier: MIT
// Weights of the geometry-aware filter that averages an interleaved cell without crossing an edge.
#ifndef BILATERAL_GLSL
#define BILATERAL_GLSL

// Weight along one axis at integer offset i of a box of width 2 half (a multiple of the cell): the two end taps share
// one period, so that every group of the cell weighs the same wherever the box is centred.
float cellWeight(int i, int halfWidth)
{
    return abs(i) == halfWidth ? 0.5 : 1.0;
}

// Weight of a neighbour's surface for a receiver. distance: of the neighbour from the receiver's plane, in units of the distance at
// which the weight falls to 1/e. cosine: of the angle between their normals.
float surfaceWeight(float distance, float cosine)
{
    float c = max(cosine, 0.0);
    c *= c;
    c *= c;
    c *= c;
    c *= c;
    return exp(-distance * distance) * c * c;
}

// One over the square of the angle between normals at which a lobe's neighbour weighs 1/e: so many of the lobe's alphas.
float lobeNarrowness(float roughness, float alphas)
{
    float angle = alphas * max(roughness * roughness, 1e-4);
    return 1.0 / (angle * angle);
}

// How far a lobe turns between two pixels at most, as an angle of half vectors. normals: their difference. view: angle between the
// view rays, of which a half vector turns by half.
float lobeTurn(vec3 normals, float view)
{
    return length(normals) + 0.5 * view;
}

// Weight of a neighbour for a lobe.
float lobeWeight(float turn, float narrowness)
{
    return exp(-turn * turn * narrowness);
}

// The same by the difference of their roughnesses.
float alikeWeight(float difference)
{
    return exp(-100.0 * difference * difference);
}

#endif
