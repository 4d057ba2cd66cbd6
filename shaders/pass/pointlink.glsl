// SPDX-License-Identifier: MIT
// What a ray meets that left a probe or a surface point, as a 16-bit code.
#ifndef POINTLINK_GLSL
#define POINTLINK_GLSL

#include "lib/limits.glsl"

uniform sampler2D pointRadianceMap;

// Where the textures of points have a point.
ivec2 pointTexel(int point)
{
    return ivec2(point % POINT_SIDE, point / POINT_SIDE);
}

// The number of the point that is met; negative: none.
int linkedPoint(float code)
{
    return int(65535.0 * code + 0.5) - 2;
}

// The radiance that comes along the ray; alpha is 1 if the ray meets a surface. Code 0 is the inside of a body, 1 no surface, and from 2
// on the codes are the numbers of points.
vec4 linkSends(float code)
{
    int point = linkedPoint(code);
    if (point == -1) return vec4(0.0);
    if (point < 0) return vec4(0.0, 0.0, 0.0, 1.0);
    return vec4(texelFetch(pointRadianceMap, pointTexel(point), 0).rgb, 1.0);
}

#endif
