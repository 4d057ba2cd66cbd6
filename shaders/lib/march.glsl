// SPDX-License-Identifier: MIT
// Where does a ray meet a surface that the view shows? Points along the ray, denser near its origin, are compared with the depth
// buffer. Bisection refines the first one that lies behind it [indirect2.md 3].
#ifndef MARCH_GLSL
#define MARCH_GLSL

#include "lib/depth.glsl"

struct ScreenRay {
    mat4 projection;
    mat4 inverseProjection;
    vec2 size;        // viewport, pixels
    vec3 origin;      // eye space
    vec3 direction;   // eye space, unit
    float most;       // length, eye units
    float thickness;  // assumed depth of what the view shows, eye units
};

struct ScreenHit {
    bool found;
    ivec2 pixel;
    float border;  // distance from the border of the view, in halves of it: 0 there, 1 in the middle
};

// The length at which the ray leaves the view, or at which it has its whole length.
float screenRayEnd(ScreenRay ray)
{
    vec4 from = ray.projection * vec4(ray.origin, 1.0);
    vec4 along = ray.projection * vec4(ray.direction, 0.0);
    float end = ray.most;
    for (int k = 0; k < 5; ++k) {
        // w + x, w - x, w + y, w - y, w + z: all above 0 in the view
        float side = k == 1 || k == 3 ? -1.0 : 1.0;
        float a = from.w + side * (k < 2 ? from.x : k < 4 ? from.y : from.z);
        float b = along.w + side * (k < 2 ? along.x : k < 4 ? along.y : along.z);
        if (b < 0.0) end = min(end, max(-a / b, 0.0));
    }
    return end;
}

vec2 screenRayNdc(ScreenRay ray, vec3 p)
{
    vec4 c = ray.projection * vec4(p, 1.0);
    return vec2(c) / c.w;
}

ivec2 screenRayPixel(ScreenRay ray, vec2 ndc)
{
    return ivec2(clamp(0.5 * ndc + 0.5, vec2(0.0), vec2(0.999999)) * ray.size);
}

// Distance along the view from the surface in the pixel of the ray's point at t to that point; negative if the point is in front of it,
// or if the pixel shows nothing.
float screenRayBehind(sampler2D depthMap, ScreenRay ray, float t)
{
    vec3 p = ray.origin + t * ray.direction;
    vec2 ndc = screenRayNdc(ray, p);
    float depth = texelFetch(depthMap, screenRayPixel(ray, ndc), 0).x;
    if (depth >= 1.0) return -1.0;
    return eyeFromDepth(ray.inverseProjection, ndc, depth).z - p.z;
}

// phase in (0,1] shifts the points.
ScreenHit screenRayHit(sampler2D depthMap, ScreenRay ray, int steps, float phase)
{
    ScreenHit hit;
    hit.found = false;
    hit.pixel = ivec2(0);
    hit.border = 0.0;
    float end = screenRayEnd(ray);
    float before = 0.0;
    float after = 0.0;
    bool crossed = false;
    for (int j = 0; j < steps && !crossed; ++j) {
        float s = (float(j) + phase) / float(steps);
        before = after;
        after = end * s * s;
        crossed = screenRayBehind(depthMap, ray, after) > 0.0;
    }
    if (!crossed) return hit;
    for (int j = 0; j < 5; ++j) {
        float middle = 0.5 * (before + after);
        if (screenRayBehind(depthMap, ray, middle) > 0.0)
            after = middle;
        else
            before = middle;
    }
    float behind = screenRayBehind(depthMap, ray, after);
    hit.found = behind > 0.0 && behind < ray.thickness + (after - before);
    vec2 ndc = screenRayNdc(ray, ray.origin + after * ray.direction);
    hit.pixel = screenRayPixel(ray, ndc);
    hit.border = min(1.0 - abs(ndc.x), 1.0 - abs(ndc.y));
    return hit;
}

#endif
