#version 330 compatibility
// SPDX-License-Identifier: MIT
// Where the frame before showed a surface that has moved since.
uniform sampler2D depthMap;
uniform mat4 formerProjection;
uniform vec2 viewportSize;
uniform vec2 subpixel;   // shift of this frame's picture
uniform float isChanged; // 1: the vertices are others than they were, and where that was is not known

in vec3 place;
in vec3 formerPlace;

layout(location = 0) out vec4 motion; // the way there, in sizes of the picture; by how much that was farther; 1: there is one

const vec2 NOWHERE = vec2(2.0); // out of the picture
// Two ways to the same depth differ in their roundings.
const float SAME_DEPTH = 1e-3;
const float DEPTH_ROUNDING = 1e-6;

void main()
{
    float depth = texelFetch(depthMap, ivec2(gl_FragCoord.xy), 0).r;
    float tolerance = SAME_DEPTH * (1.0 - depth) + DEPTH_ROUNDING + 0.1 * fwidth(gl_FragCoord.z);
    if (!(abs(gl_FragCoord.z - depth) <= tolerance)) discard;
    vec4 former = formerProjection * vec4(formerPlace, 1.0);
    vec2 ndc = gl_FragCoord.xy / viewportSize * 2.0 - 1.0 - subpixel;
    bool isKnown = former.w > 0.0 && isChanged == 0.0;
    motion = vec4(isKnown ? 0.5 * (former.xy / former.w - ndc) : NOWHERE, place.z - formerPlace.z, 1.0);
}
