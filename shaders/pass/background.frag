#version 330 compatibility
// SPDX-License-Identifier: MIT
// The radiance of the map where there is no surface. Alpha: 0.

#include "pass/picture.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    radiance = backgroundPicture(ivec2(gl_FragCoord.xy));
}
