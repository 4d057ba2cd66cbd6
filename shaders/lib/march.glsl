// SPDX-License-Identifier: MIT
// Where does a ray meet a surface that the view shows? Points along the ray, denser near its origin, are compared with the depth
// buffer. Bisection refines where they pass behind it [indirect2.md 3].
#ifndef MARCH_GLSL
#define MARCH_GLSL

#include "lib/depth.glsl"

struct ScreenRay {
    mat4 inverseProjection;
    vec2 size;        // viewport, pixels
    vec3 origin;      // eye space
    vec3 direction;   // eye space, unit
    vec4 clipOrigin;  // the same in clip space
    vec4 clipDirection;
    float most;       // length, eye units
    float tolerance;  // distance from the plane of a surface at which the ray still hits it, eye units
};

struct ScreenHit {
    bool found;
    ivec2 pixel;
    float distance;  // along the ray
    float border;  // distance from the border of the view, in halves of it: 0 there, 1 in the middle
};

ScreenRay screenRay(mat4 projection, mat4 inverseProjection, vec2 size, vec3 origin, vec3 direction, float most, float tolerance)
{
    ScreenRay ray;
    ray.inverseProjection = inverseProjection;
    ray.size = size;
    ray.origin = origin;
    ray.direction = direction;
    ray.clipOrigin = projection * vec4(origin, 1.0);
    ray.clipDirection = projection * vec4(direction, 0.0);
    ray.most = most;
    ray.tolerance = tolerance;
    return ray;
}

// The length at which the ray leaves the view, or at which it has its whole length.
float screenRayEnd(ScreenRay ray)
{
    vec4 from = ray.clipOrigin;
    vec4 along = ray.clipDirection;
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

vec2 screenRayNdc(vec4 clip)
{
    return vec2(clip) / clip.w;
}

ivec2 screenRayPixel(ScreenRay ray, vec2 ndc)
{
    return ivec2(clamp(0.5 * ndc + 0.5, vec2(0.0), vec2(0.999999)) * ray.size);
}

// Whether the ray's point at t is behind the surface in its pixel. Clip space tells: it changes evenly along the ray.
bool screenRayBehind(sampler2D depthMap, ScreenRay ray, float t)
{
    vec4 clip = ray.clipOrigin + t * ray.clipDirection;
    float depth = texelFetch(depthMap, screenRayPixel(ray, screenRayNdc(clip)), 0).x;
    return depth < 1.0 && clip.z > (2.0 * depth - 1.0) * clip.w;
}

// Whether the ray's point at t lies on the plane of the surface in its pixel, and that surface faces the ray. error: of t.
bool screenRayMeets(sampler2D depthMap, sampler2D normalMap, ScreenRay ray, float t, float error)
{
    vec3 p = ray.origin + t * ray.direction;
    ivec2 pixel = screenRayPixel(ray, screenRayNdc(ray.clipOrigin + t * ray.clipDirection));
    vec3 n = normalize(vec3(texelFetch(normalMap, pixel, 0)) * 2.0 - 1.0);
    if (dot(n, ray.direction) >= 0.0) return false;
    vec2 ndc = (vec2(pixel) + 0.5) / ray.size * 2.0 - 1.0;
    vec3 surface = eyeFromDepth(ray.inverseProjection, ndc, texelFetch(depthMap, pixel, 0).x);
    return abs(dot(n, p - surface)) < ray.tolerance + error;
}

// phase in (0,1] shifts the points. A ray that passes behind the edge of a surface does not hit it, and the search goes on. One loop
// takes the points and the bisections: nested loops would wait for the slowest of the pixels that run together, at each point.
ScreenHit screenRayHit(sampler2D depthMap, sampler2D normalMap, ScreenRay ray, int steps, float phase)
{
    const int halvings = 5;
    float end = screenRayEnd(ray);
    float before = 0.0;  // the point before
    float after = 0.0;   // the first behind a surface
    bool wasBehind = false;
    bool found = false;
    int j = 0;
    int left = 0;  // halvings
    while (!found && (left > 0 || j < steps)) {
        bool halves = left > 0;
        float s = (float(j) + phase) / float(steps);
        float t = halves ? 0.5 * (before + after) : end * s * s;
        bool isBehind = screenRayBehind(depthMap, ray, t);
        if (isBehind && (halves || !wasBehind)) after = t;
        if (halves) {
            if (!isBehind) before = t;
            --left;
            if (left == 0) {
                found = screenRayMeets(depthMap, normalMap, ray, after, after - before);
                before = after;
            }
        } else {
            if (isBehind && !wasBehind)
                left = halvings;
            else
                before = t;
            wasBehind = isBehind;
            ++j;
        }
    }
    vec2 ndc = screenRayNdc(ray.clipOrigin + after * ray.clipDirection);
    ScreenHit hit;
    hit.found = found;
    hit.pixel = screenRayPixel(ray, ndc);
    hit.distance = after;
    hit.border = min(1.0 - abs(ndc.x), 1.0 - abs(ndc.y));
    return hit;
}

#endif
