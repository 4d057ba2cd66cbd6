// SPDX-License-Identifier: MIT
// A ray from a pixel of a still view through the scene's triangles, in another direction each frame.
#ifndef PIXELRAY_GLSL
#define PIXELRAY_GLSL

#include "lib/sequence.glsl"
#include "pass/gbuffer.glsl"

uniform mat4 placesFromEye;  // to the origin of the triangles, of which places are told
uniform vec2 sampleShift;    // of this frame
uniform float sampleFrames;  // its number

// Off the surface of a pixel with normal n, in eye space.
vec3 rayOrigin(ivec2 p, vec3 n)
{
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    float lift = pixelFootprint(inverseProjection, ndc, depth, viewportSize) + length(depthStep(inverseProjection, ndc, depth));
    return eyeFromDepth(inverseProjection, ndc, depth) + lift * n;
}

// This frame's point of the unit square, to be taken modulo 1. The 16 pixels of a cell share one set; each cell has another one.
vec2 rayPoint(ivec2 p)
{
    uint cell = uint(p.x / 4) + 65536u * uint(p.y / 4);
    return sampleShift + cellPoint(0, float(bayer4(p.x, p.y)), 1) + vec2(pixelNumber(cell, 0u), pixelNumber(cell, 1u));
}

// For pixelNumber().
uint rayPixel(ivec2 p)
{
    return uint(p.x) + 65536u * uint(p.y);
}

#endif
