// SPDX-License-Identifier: MIT
// Colours bounded by others [Karis 2014; Salvi 2016].
#ifndef COLORBOX_GLSL
#define COLORBOX_GLSL

// Luma and two differences of colour: there the colours about an edge lie along one axis, and bounds are tight.
vec3 opponentFromRgb(vec3 c)
{
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}

vec3 rgbFromOpponent(vec3 c)
{
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

// Moved towards the middle of a box until it is inside.
vec3 clippedToBox(vec3 c, vec3 middle, vec3 extent)
{
    vec3 off = c - middle;
    float beyond = max(abs(off.x) / extent.x, max(abs(off.y) / extent.y, abs(off.z) / extent.z));
    return beyond > 1.0 ? middle + off / beyond : c;
}

#endif
