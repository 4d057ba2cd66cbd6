#version 330 compatibility
// SPDX-License-Identifier: MIT
// What casts shadows, into a map of the sky shadow atlas.
#pragma import_defines(CASTER_ALPHA, NO_TEXTURE)

out vec4 vertexColor;
out vec2 textureCoordinate;

void main()
{
    vertexColor = gl_Color;
    textureCoordinate = vec2(0.0);
#if defined(CASTER_ALPHA) && !defined(NO_TEXTURE)
    textureCoordinate = (gl_TextureMatrix[0] * gl_MultiTexCoord0).xy;
#endif
    gl_Position = ftransform();
}
