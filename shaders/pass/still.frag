#version 330 compatibility
// SPDX-License-Identifier: MIT
// The picture of a frame as it is shown, kept while the average of a still view is young.

#include "pass/picture.glsl"

layout(location = 0) out vec4 picture;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    picture = pictureRadiance(p, mapFromEye * viewRay(inverseProjection, pixelNdc(p)));
}
