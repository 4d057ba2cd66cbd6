#version 330 compatibility
// SPDX-License-Identifier: MIT
// What casts shadows, into a shadow map; or what reflects light, into a reflective one.
#pragma import_defines(MOVES_VERTICES, CASTER_ALPHA, CASTER_REFLECTS, NO_TEXTURE)

out vec4 vertexColor;
out vec2 textureCoordinate;
#ifdef CASTER_REFLECTS
out vec3 casterPlace;  // about the maps' origin
out vec3 casterNormal;
#endif

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
#ifdef CASTER_REFLECTS
    casterPlace = vec3(gl_ModelViewMatrix * gl_Vertex);
    casterNormal = gl_NormalMatrix * gl_Normal;
#endif
}
