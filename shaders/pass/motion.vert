#version 330 compatibility
// SPDX-License-Identifier: MIT
// What has moved since the frame before: where it is, and where it was.
#pragma import_defines(MOVES_VERTICES)

uniform mat4 projection;
uniform mat4 eyeFromModel;
uniform mat4 formerEyeFromModel;

out vec3 place;        // before the eye,
out vec3 formerPlace;  // and in the frame before, before the eye of that

#ifdef MOVES_VERTICES
void envlightVertex(inout vec4 vertex, inout vec3 normal);  // of the application's
#endif

void main()
{
    vec4 vertex = gl_Vertex;
#ifdef MOVES_VERTICES
    vec3 normal = gl_Normal;
    envlightVertex(vertex, normal);
#endif
    vec4 p = eyeFromModel * vertex;
    vec4 former = formerEyeFromModel * vertex;
    place = p.xyz / p.w;
    formerPlace = former.xyz / former.w;
    gl_Position = projection * p;
}
