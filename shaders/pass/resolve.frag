#version 330 compatibility
// SPDX-License-Identifier: MIT
// The one place where the terms meet: the radiance of the picture and of what is behind it. Alpha: 1 where there is a surface.

#include "pass/picture.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    radiance = pictureRadiance(p, mapFromEye * viewRay(inverseProjection, pixelNdc(p)));
}
