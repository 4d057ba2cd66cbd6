#version 330 compatibility
// SPDX-License-Identifier: MIT
// Transparent surfaces of the host, drawn after the composite in its own bins.
#include "pass/forwardlight.glsl"
#include "pass/surface.glsl"

layout(location = 0) out vec4 color;

void main()
{
    color = forwardColor(readSurface());
}
