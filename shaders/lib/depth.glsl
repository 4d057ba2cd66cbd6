// SPDX-License-Identifier: MIT
// Eye space from the depth buffer, for any projection: perspective, orthographic, off-axis. Depth in [0,1].
#ifndef DEPTH_GLSL
#define DEPTH_GLSL

// Eye-space point at normalised device coordinates ndc.xy in [-1,1] and depth.
vec3 eyeFromDepth(mat4 inverseProjection, vec2 ndc, float depth)
{
    vec4 q = inverseProjection * vec4(ndc, 2.0 * depth - 1.0, 1.0);
    return vec3(q) / q.w;
}

// Unit direction away from the eye along the view ray through ndc, parallel rays included. Between depths 0 and 1/2: in
// float a far plane 1e8 times the near one is at infinity.
vec3 viewRay(mat4 inverseProjection, vec2 ndc)
{
    return normalize(eyeFromDepth(inverseProjection, ndc, 0.5) - eyeFromDepth(inverseProjection, ndc, 0.0));
}

// The same through an eye point: column 2 is the centre of projection, which for parallel rays lies at infinity. Its sign is
// that in which depths grow.
vec3 viewRayAt(mat4 inverseProjection, vec3 p)
{
    vec4 centre = inverseProjection[2];
    float away = centre.w != 0.0 ? -centre.w : -centre.z;
    return normalize((vec3(centre) - centre.w * p) * (away < 0.0 ? -1.0 : 1.0));
}

// Length in eye units of one pixel's side at depth, across the view ray.
float pixelFootprint(mat4 inverseProjection, vec2 ndc, float depth, vec2 size)
{
    vec3 a = eyeFromDepth(inverseProjection, ndc, depth);
    vec3 b = eyeFromDepth(inverseProjection, ndc + vec2(0.0, 2.0 / size.y), depth);
    return length(a - b);
}

// Two steps of a 24-bit depth buffer at depth, towards the eye, in eye space.
vec3 depthStep(mat4 inverseProjection, vec2 ndc, float depth)
{
    return eyeFromDepth(inverseProjection, ndc, depth - 1.2e-7) - eyeFromDepth(inverseProjection, ndc, depth);
}

// By how much depth changes from a pixel to the next, at d in a line of five: of a plane it changes evenly in any projection.
// From both sides if they agree, else from the one that goes on more evenly. y: by how much its pixels do not.
vec2 depthSlope(float d0, float d1, float d, float d3, float d4)
{
    float before = abs(d0 - 2.0 * d1 + d);
    float after = abs(d - 2.0 * d3 + d4);
    float across = 0.25 * abs(d0 - 2.0 * d + d4);
    if (across <= 2.0 * min(before, after) + 2e-7) return vec2(0.25 * (d4 - d0), max(before, after));
    return before < after ? vec2(d - d1, before) : vec2(d3 - d, after);
}

#endif
