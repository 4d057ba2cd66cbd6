// SPDX-License-Identifier: MIT
// Is a direction blocked, as far as the depth buffer knows? The ray march of systems.md S5: k points along the ray,
// denser near the receiver, each compared with the surface seen at its pixel.
#ifndef VISIBILITY_GLSL
#define VISIBILITY_GLSL

#include "lib/depth.glsl"

// What the march needs to know of the view and of the receiver.
struct RayMarch {
    mat4 projection;
    mat4 inverseProjection;
    vec2 size;        // viewport, pixels
    float radius;     // length of the ray, eye units
    float thickness;  // assumed depth of what the view shows, eye units
    int steps;
    vec4 clip;        // the receiver in clip space
    vec3 eye;         // the receiver in eye space
    vec4 plane;       // the receiver's tangent plane, lifted by the bias, against points (ndc, 1)
};

// The receiver at eye point p with unit normal n. bias [eye units] must cover the rounding of the depth buffer; a
// surface counts as an occluder only above the receiver's own lifted plane, so a flat plane never occludes itself.
RayMarch rayMarchFrom(RayMarch m, vec3 p, vec3 n, float bias)
{
    m.eye = p;
    m.clip = m.projection * vec4(p, 1.0);
    m.plane = vec4(n, -dot(n, p) - bias) * m.inverseProjection;
    return m;
}

// 1 if the unit eye direction l is blocked within the radius, else 0. phase in [0,1) shifts the points along the ray.
float rayBlocked(sampler2D depthMap, RayMarch m, vec3 l, float phase)
{
    vec4 clipStep = m.projection * vec4(l, 0.0);
    for (int j = 0; j < m.steps; ++j) {
        float s = (float(j) + phase) / float(m.steps);
        float t = m.radius * s * s;
        vec4 c = m.clip + t * clipStep;
        if (c.w <= 0.0 || abs(c.x) >= c.w || abs(c.y) >= c.w) return 0.0;
        ivec2 texel = ivec2((0.5 * vec2(c) / c.w + 0.5) * m.size);
        float depth = texelFetch(depthMap, texel, 0).x;
        if (depth >= 1.0) continue;
        // The surface is known at the texel's centre: taken elsewhere in the texel it would leave its own plane.
        vec2 ndc = (vec2(texel) + 0.5) / m.size * 2.0 - 1.0;
        if (dot(m.plane, vec4(ndc, 2.0 * depth - 1.0, 1.0)) <= 0.0) continue;
        float behind = eyeFromDepth(m.inverseProjection, ndc, depth).z - (m.eye.z + t * l.z);
        if (behind > 0.0 && behind < m.thickness) return 1.0;
    }
    return 0.0;
}

// How far one point of the ray, at a share of its length, is hidden from the eye: seed 000, 3.2, as printed, for comparison.
float pointHidden(sampler2D depthMap, RayMarch m, vec3 l, float share)
{
    float t = m.radius * share;
    vec4 c = m.clip + t * (m.projection * vec4(l, 0.0));
    if (c.w <= 0.0 || abs(c.x) >= c.w || abs(c.y) >= c.w) return 0.0;
    ivec2 texel = ivec2((0.5 * vec2(c) / c.w + 0.5) * m.size);
    float depth = texelFetch(depthMap, texel, 0).x;
    if (depth >= 1.0) return 0.0;
    vec2 ndc = (vec2(texel) + 0.5) / m.size * 2.0 - 1.0;
    if (dot(m.plane, vec4(ndc, 2.0 * depth - 1.0, 1.0)) <= 0.0) return 0.0;
    float behind = eyeFromDepth(m.inverseProjection, ndc, depth).z - (m.eye.z + t * l.z);
    float far = behind / m.radius;
    return behind > 0.0 ? max(1.0 - far * far, 0.0) : 0.0;
}

#endif
