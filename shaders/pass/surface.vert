#version 330 compatibility
// SPDX-License-Identifier: MIT
// Geometry of the host's own drawables, for the G-buffer and for what is drawn forward.
#pragma import_defines(MOVES_VERTICES, HAS_SUN_MAPS, CLIP_PLANES, NO_TEXTURE, TEXGEN_OBJECT, TEXGEN_EYE, TEXGEN_PROJECTED, NORMAL_MAP, METAL_ROUGH_MAP, EMISSION_MAP, COAT_MAP, COAT_ROUGHNESS_MAP, COAT_NORMAL_MAP, ENVLIGHT_ANISOTROPY, VERTEX_TANGENTS, TEXTURE_STAGES)
#if defined(NORMAL_MAP) || defined(METAL_ROUGH_MAP) || defined(EMISSION_MAP) || defined(ENVLIGHT_ANISOTROPY)
#define HAS_MAPS
#endif
#if defined(COAT_MAP) || defined(COAT_ROUGHNESS_MAP) || defined(COAT_NORMAL_MAP)
#define HAS_MAPS
#endif

#ifdef VERTEX_TANGENTS
layout(location = 6) in vec4 vertexTangent;  // Material::tangentAttribute; w: the sign of the bitangent
#endif

uniform vec2 subpixel;  // shift of the picture in clip space over w

out vec3 eyePosition;
out vec3 eyeNormal;
#ifdef HAS_SUN_MAPS
flat out vec3 cornerPosition;  // of one corner of the triangle
flat out vec3 cornerNormal;
#endif
#ifdef VERTEX_TANGENTS
out vec3 eyeTangent;
out vec3 eyeBitangent;
#endif
out vec4 vertexColor;
out vec3 textureCoordinate;  // s, t, q
#ifdef HAS_MAPS
out vec4 mapCoordinates;     // of the arrays 0 and 1
#endif
#ifdef TEXTURE_STAGES
#include "lib/limits.glsl"
uniform int stageCoordinateKinds[STAGED_UNITS];
uniform int stageUnits[STAGED_UNITS];
out vec3 stageCoordinates[4];  // s, t, q of the stages 0 to 3

// Of the stage's unit, as its planes have them, if it generates them.
vec3 stageCoordinate(int stage, vec4 given, vec4 vertex, vec4 eye)
{
    int kind = stageCoordinateKinds[stage];
    int unit = stageUnits[stage];
    bool byEye = (kind & STAGE_OF_EYE) != 0;
    vec4 p = byEye ? eye : vertex;
    if ((kind & STAGE_OF_FIRST) != 0) given = gl_MultiTexCoord0;
    if ((kind & (STAGE_OF_OBJECT | STAGE_OF_EYE)) != 0) {
        given.x = dot(p, byEye ? gl_EyePlaneS[unit] : gl_ObjectPlaneS[unit]);
        given.y = dot(p, byEye ? gl_EyePlaneT[unit] : gl_ObjectPlaneT[unit]);
    }
    if ((kind & STAGE_PROJECTED) != 0) given.w = dot(p, byEye ? gl_EyePlaneQ[unit] : gl_ObjectPlaneQ[unit]);
    return (gl_TextureMatrix[unit] * given).xyw;
}
#endif

#ifdef MOVES_VERTICES
void envlightVertex(inout vec4 vertex, inout vec3 normal);  // of the application's
#endif

void main()
{
    vec4 vertex = gl_Vertex;
    vec3 normal = gl_Normal;
#ifdef MOVES_VERTICES
    envlightVertex(vertex, normal);
#endif
    eyePosition = vec3(gl_ModelViewMatrix * vertex);
    eyeNormal = gl_NormalMatrix * normal;
#ifdef HAS_SUN_MAPS
    cornerPosition = eyePosition;
    cornerNormal = eyeNormal;
#endif
#ifdef VERTEX_TANGENTS
    eyeTangent = mat3(gl_ModelViewMatrix) * vertexTangent.xyz;
    eyeBitangent = mat3(gl_ModelViewMatrix) * (vertexTangent.w * cross(normal, vertexTangent.xyz));
#endif
    vertexColor = gl_Color;
#ifndef NO_TEXTURE
    vec4 coordinate = gl_MultiTexCoord0;
#ifdef TEXGEN_OBJECT
    coordinate.xy = vec2(dot(vertex, gl_ObjectPlaneS[0]), dot(vertex, gl_ObjectPlaneT[0]));
#endif
#ifdef TEXGEN_EYE
    vec4 eye = gl_ModelViewMatrix * vertex;
    coordinate.xy = vec2(dot(eye, gl_EyePlaneS[0]), dot(eye, gl_EyePlaneT[0]));
#endif
#if defined(TEXGEN_OBJECT) && defined(TEXGEN_PROJECTED)
    coordinate.w = dot(vertex, gl_ObjectPlaneQ[0]);
#endif
#if defined(TEXGEN_EYE) && defined(TEXGEN_PROJECTED)
    coordinate.w = dot(eye, gl_EyePlaneQ[0]);
#endif
    textureCoordinate = (gl_TextureMatrix[0] * coordinate).xyw;
#else
    textureCoordinate = vec3(0.0, 0.0, 1.0);
#endif
#ifdef HAS_MAPS
    mapCoordinates = vec4(gl_MultiTexCoord0.xy, gl_MultiTexCoord1.xy);
#endif
#ifdef TEXTURE_STAGES
    vec4 eyeVertex = gl_ModelViewMatrix * vertex;
    stageCoordinates[0] = stageCoordinate(0, gl_MultiTexCoord0, vertex, eyeVertex);
    stageCoordinates[1] = stageCoordinate(1, gl_MultiTexCoord1, vertex, eyeVertex);
    stageCoordinates[2] = stageCoordinate(2, gl_MultiTexCoord2, vertex, eyeVertex);
    stageCoordinates[3] = stageCoordinate(3, gl_MultiTexCoord3, vertex, eyeVertex);
#endif
#ifdef MOVES_VERTICES
    gl_Position = gl_ModelViewProjectionMatrix * vertex;
#else
    gl_Position = ftransform();
#endif
    gl_Position.xy += subpixel * gl_Position.w;
#ifdef CLIP_PLANES
    gl_ClipVertex = gl_ModelViewMatrix * vertex;  // for the host's clip planes
#endif
}
