#version 330 compatibility
// SPDX-License-Identifier: MIT
// One triangle that covers the viewport.
void main()
{
    gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
