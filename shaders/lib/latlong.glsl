// SPDX-License-Identifier: MIT
// The latitude-longitude environment: direction <-> image coordinates, in Blender's convention.
// uv in [0,1]^2, v from the TOP row (+Z) down; the image centre looks along +X; columns run clockwise seen from above.
#ifndef LATLONG_GLSL
#define LATLONG_GLSL

#include "lib/constants.glsl"

// Image coordinates of direction d (any length > 0). The polar angle comes from atan, which keeps its digits near the
// poles where acos(d.z) loses half of them.
vec2 latlongFromDirection(vec3 d)
{
    float theta = atan(length(vec2(d)), d.z);
    float phi = d.x == 0.0 && d.y == 0.0 ? 0.0 : atan(d.y, d.x);
    return vec2(0.5 - phi / TWO_PI, theta / PI);
}

// Unit direction at image coordinates uv.
vec3 directionFromLatlong(vec2 uv)
{
    float phi = TWO_PI * (0.5 - uv.x);
    float theta = PI * uv.y;
    float sinTheta = sin(theta);
    return vec3(sinTheta * cos(phi), sinTheta * sin(phi), cos(theta));
}

// Exact solid angle [sr] of a texel of row y (0 at the top) in an image of size.x by size.y texels. The product form
// of cos(top) - cos(bottom) does not cancel at the poles; the sine is that of the angle from the nearer pole.
float latlongTexelSolidAngle(float y, vec2 size)
{
    float dTheta = PI / size.y;
    return TWO_PI / size.x * 2.0 * sin((min(y, size.y - 1.0 - y) + 0.5) * dTheta) * sin(0.5 * dTheta);
}

#endif
