#version 330 compatibility
// SPDX-License-Identifier: MIT
// Geometry of the host's own drawables, for the G-buffer and for what is drawn forward.
#pragma import_defines(NO_TEXTURE)

uniform vec2 subpixel;  // shift of the picture in clip space over w

out vec3 eyePosition;
out vec3 eyeNormal;
out vec4 vertexColor;
out vec2 textureCoordinate;

void main()
{
    eyePosition = vec3(gl_ModelViewMatrix * gl_Vertex);
    eyeNormal = gl_NormalMatrix * gl_Normal;
    vertexColor = gl_Color;
#ifndef NO_TEXTURE
    textureCoordinate = (gl_TextureMatrix[0] * gl_MultiTexCoord0).xy;
#else
    textureCoordinate = vec2(0.0);
#endif
    gl_Position = ftransform();
    gl_Position.xy += subpixel * gl_Position.w;
}
