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

// Weight of a neighbour at eye point q with normal nq for the receiver at p with normal n on a plane of normal facet: its
// distance from that plane in pixel footprints, and the angle of the normals.
float geometryWeight(vec3 p, vec3 facet, vec3 n, vec3 q, vec3 nq, float footprint)
{
    float plane = dot(facet, q - p) / (1.5 * footprint);
    float c = max(dot(n, nq), 0.0);
    c *= c;
    c *= c;
    c *= c;
    c *= c;
    return exp(-plane * plane) * c * c;
}

#endif
