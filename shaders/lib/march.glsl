// SPDX-License-Identifier: MIT
// Where does a ray meet a surface that the view shows? Points along the ray, denser near its origin, are compared with the depth
// buffer. Bisection refines where they pass behind it [indirect2.md 3].
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
    float thickness;  // how far from a surface's plane the ray may come out behind it, eye units
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

// Narrows down the lengths between which the ray passes behind a surface of the view.
vec2 screenRayCrossing(sampler2D depthMap, ScreenRay ray, vec2 between)
{
    for (int j = 0; j < 5; ++j) {
        float middle = 0.5 * (between.x + between.y);
        if (screenRayBehind(depthMap, ray, middle) > 0.0)
            between.y = middle;
        else
            between.x = middle;
    }
    return between;
}

// Whether the ray meets the plane of the surface in the pixel of its point at t, from before. along: length by which t is uncertain.
bool screenRayMeets(sampler2D depthMap, sampler2D normalMap, ScreenRay ray, float t, float along)
{
    vec3 p = ray.origin + t * ray.direction;
    ivec2 pixel = screenRayPixel(ray, screenRayNdc(ray, p));
    vec3 n = normalize(vec3(texelFetch(normalMap, pixel, 0)) * 2.0 - 1.0);
    if (dot(n, ray.direction) >= 0.0) return false;
    vec2 ndc = (vec2(pixel) + 0.5) / ray.size * 2.0 - 1.0;
    vec3 surface = eyeFromDepth(ray.inverseProjection, ndc, texelFetch(depthMap, pixel, 0).x);
    return abs(dot(n, p - surface)) < ray.thickness + along;
}

// phase in (0,1] shifts the points. Where a surface ends, rays pass behind it: that is no hit, and the search goes on.
ScreenHit screenRayHit(sampler2D depthMap, sampler2D normalMap, ScreenRay ray, int steps, float phase)
{
    ScreenHit hit;
    hit.found = false;
    hit.pixel = ivec2(0);
    hit.border = 0.0;
    float end = screenRayEnd(ray);
    float before = 0.0;
    bool wasBehind = false;
    for (int j = 0; j < steps && !hit.found; ++j) {
        float s = (float(j) + phase) / float(steps);
        float after = end * s * s;
        bool isBehind = screenRayBehind(depthMap, ray, after) > 0.0;
        if (isBehind && !wasBehind) {
            vec2 crossing = screenRayCrossing(depthMap, ray, vec2(before, after));
            hit.found = screenRayMeets(depthMap, normalMap, ray, crossing.y, crossing.y - crossing.x);
            vec2 ndc = screenRayNdc(ray, ray.origin + crossing.y * ray.direction);
            hit.pixel = screenRayPixel(ray, ndc);
            hit.border = min(1.0 - abs(ndc.x), 1.0 - abs(ndc.y));
        }
        wasBehind = isBehind;
        before = after;
    }
    return hit;
}

#endif
