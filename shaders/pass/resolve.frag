#version 330 compatibility
// SPDX-License-Identifier: MIT
// The one place where the terms meet: the radiance of the surfaces. Alpha: coverage.

#include "pass/catchers.glsl"
#include "pass/pixelfog.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    radiance = isBackground(p) ? vec4(0.0) : surfacePicture(p, throughFog(emissionMap, p, termSum(p)));
}
