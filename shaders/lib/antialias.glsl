// SPDX-License-Identifier: MIT
// Smooths the staircases of edges in a finished picture. The distances to the staircase's next steps tell where in a pixel the edge
// runs [Reshetov 2009; Lottes 2009].
#ifndef ANTIALIAS_GLSL
#define ANTIALIAS_GLSL

const float LEAST_EDGE = 0.04;        // contrast in display values that is seen as an edge,
const float LEAST_EDGE_SHARE = 0.125; // and as a share of the brighter side
const int EDGE_REACH = 12;            // pixels to either side

// What is mixed into a pixel: that share of its neighbour.
struct EdgeShift {
    ivec2 side;
    float share;
};

// Luma of display values, and coverage, so that edges of like brightness against what is behind the scene count.
float edgeMeasure(sampler2D picture, ivec2 p)
{
    vec4 c = texelFetch(picture, clamp(p, ivec2(0), textureSize(picture, 0) - 1), 0);
    return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b + 0.25 * c.a;
}

// How far the edge between two rows runs from p on, and by how much the mean of both differs where it ends.
vec2 edgeEnd(sampler2D picture, ivec2 p, ivec2 side, ivec2 along, float middle, float contrast)
{
    // Compilers unroll a loop whose end they know, and software renderers would then go all the way at every pixel.
    int reach = contrast > 0.0 ? EDGE_REACH : 0;
    float least = 0.25 * contrast;
    float difference = 0.0;
    int i = 0;
    while (i < reach && abs(difference) < least) {
        ++i;
        ivec2 q = p + i * along;
        difference = 0.5 * (edgeMeasure(picture, q) + edgeMeasure(picture, q + side)) - middle;
    }
    if (abs(difference) >= least) return vec2(float(i) - 0.5, difference);
    return vec2(float(EDGE_REACH) + 0.5, 0.0);
}

EdgeShift edgeShift(sampler2D picture, ivec2 p)
{
    ivec2 x = ivec2(1, 0);
    ivec2 y = ivec2(0, 1);
    float own = edgeMeasure(picture, p);
    float left = edgeMeasure(picture, p - x);
    float right = edgeMeasure(picture, p + x);
    float below = edgeMeasure(picture, p - y);
    float above = edgeMeasure(picture, p + y);
    EdgeShift shift;
    shift.side = ivec2(0);
    shift.share = 0.0;
    float most = max(own, max(max(left, right), max(below, above)));
    float least = min(own, min(min(left, right), min(below, above)));
    if (most - least < max(LEAST_EDGE, LEAST_EDGE_SHARE * most)) return shift;

    float leftBelow = edgeMeasure(picture, p - x - y);
    float rightBelow = edgeMeasure(picture, p + x - y);
    float leftAbove = edgeMeasure(picture, p - x + y);
    float rightAbove = edgeMeasure(picture, p + x + y);
    float acrossRows = abs(leftAbove + leftBelow - 2.0 * left) + 2.0 * abs(above + below - 2.0 * own) +
                       abs(rightAbove + rightBelow - 2.0 * right);
    float acrossColumns = abs(leftAbove + rightAbove - 2.0 * above) + 2.0 * abs(left + right - 2.0 * own) +
                          abs(leftBelow + rightBelow - 2.0 * below);
    bool rows = acrossRows >= acrossColumns;  // the edge runs along them
    float before = rows ? below : left;
    float after = rows ? above : right;
    bool isAfter = abs(after - own) >= abs(before - own);
    ivec2 side = (rows ? y : x) * (isAfter ? 1 : -1);
    float other = isAfter ? after : before;
    float middle = 0.5 * (own + other);
    float contrast = abs(other - own);
    ivec2 along = rows ? x : y;
    vec2 back = edgeEnd(picture, p, side, -along, middle, contrast);
    vec2 forth = edgeEnd(picture, p, side, along, middle, contrast);
    vec2 end = back.x < forth.x ? back : forth;
    shift.side = side;
    // Only if the neighbour's side goes on at the nearer end: then the edge cuts into this pixel, not into the neighbour.
    if ((own - middle) * end.y < 0.0) shift.share = 0.5 - end.x / (back.x + forth.x);
    // Of all around a pixel beside a straight edge a third differs, and more beside the corner of a step or a lone point.
    float around = (2.0 * (left + right + below + above) + leftBelow + rightBelow + leftAbove + rightAbove) / 12.0;
    float lone = clamp(1.5 * abs(around - own) / (most - least) - 0.5, 0.0, 1.0);
    shift.share = max(shift.share, 0.5 * lone);
    return shift;
}

#endif
