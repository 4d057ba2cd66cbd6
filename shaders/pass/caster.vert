#version 330 compatibility
// SPDX-License-Identifier: MIT
// What casts shadows, into a map of the sky shadow atlas.
#pragma import_defines(MOVES_VERTICES, CASTER_ALPHA, NO_TEXTURE)

out vec4 vertexColor;
out vec2 textureCoordinate;

#ifdef MOVES_VERTICES
void envlightVertex(inout vec4 vertex, inout vec3 normal);  // of the application's
#endif

void main()
{
    vertexColor = gl_Color;
    textureCoordinate = vec2(0.0);
#if defined(CASTER_ALPHA) && !defined(NO_TEXTURE)
    textureCoordinate = (gl_TextureMatrix[0] * gl_MultiTexCoord0).xy;
#endif
#ifdef MOVES_VERTICES
    vec4 vertex = gl_Vertex;
    vec3 normal = gl_Normal;
    envlightVertex(vertex, normal);
    gl_Position = gl_ModelViewProjectionMatrix * vertex;
#else
    gl_Position = ftransform();
#endif
}
