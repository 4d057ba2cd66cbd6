// SPDX-License-Identifier: MIT
// Reading the G-buffer in a full-screen pass.
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL

#include "lib/depth.glsl"
#include "pass/brdf.glsl"

uniform sampler2D albedoMap;
uniform sampler2D normalMap;
uniform sampler2D specularMap;
uniform sampler2D depthMap;

uniform mat4 projection;
uniform mat4 inverseProjection;
uniform mat3 mapFromEye;     // rotates eye directions into the environment map's frame
uniform vec2 viewportSize;

bool isBackground(ivec2 p)
{
    return texelFetch(depthMap, p, 0).r >= 1.0;
}

vec2 pixelNdc(ivec2 p)
{
    return (vec2(p) + 0.5) / viewportSize * 2.0 - 1.0;
}

vec3 pixelEye(ivec2 p)
{
    return eyeFromDepth(inverseProjection, pixelNdc(p), texelFetch(depthMap, p, 0).r);
}

vec3 pixelNormal(ivec2 p)
{
    return normalize(texelFetch(normalMap, p, 0).xyz * 2.0 - 1.0);
}

// Unit vector to the eye, in a frame about the pixel's normal.
vec3 pixelView(ivec2 p, mat3 eyeFromLocal)
{
    vec3 v = transpose(eyeFromLocal) * -viewRay(inverseProjection, pixelNdc(p));
    v.z = max(v.z, 1e-4); // interpolated normals may lean away from the eye
    return normalize(v);
}

int pixelBrdf(ivec2 p)
{
    return int(texelFetch(specularMap, p, 0).a * 255.0 + 0.5);
}

#endif
