// SPDX-License-Identifier: MIT
// How much pixels count for each other's lobe: those of one surface, whose lobes are alike and turned by less than they are wide.
#ifndef LOBENEIGHBOURS_GLSL
#define LOBENEIGHBOURS_GLSL

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lobewidth.glsl"
#include "pass/pixelbsdf.glsl"

// The pixel whose sums are averaged.
struct LobeReceiver {
    vec3 normal;
    float roughness;
    PixelPlane plane;  // of its surface, in units of 1.5 pixels
    float viewTurn;    // angle between the view rays of two pixels side by side
};

LobeReceiver lobeReceiver(ivec2 p)
{
    vec4 here = texelFetch(normalMap, p, 0);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    LobeReceiver r;
    r.normal = normalize(here.xyz * 2.0 - 1.0);
    r.roughness = here.a;
    r.plane = pixelPlane(eyeFromDepth(inverseProjection, ndc, depth), r.normal,
                         1.5 * pixelFootprint(inverseProjection, ndc, depth, viewportSize));
    r.viewTurn = pixelTurn(ndc);
    return r;
}

// Weight of the pixel q by its surface. distance: from the receiver's pixel, in pixels. turn: of the lobe.
float lobeNeighbour(LobeReceiver r, ivec2 q, float distance, out float turn)
{
    vec4 there = texelFetch(normalMap, q, 0);
    float depth = texelFetch(depthMap, q, 0).r;
    vec3 n = there.xyz * 2.0 - 1.0;
    turn = lobeTurn(r.normal - n, distance * r.viewTurn);
    return depth < 1.0 ? alikeWeight(r.roughness - there.a) * surfaceWeight(planeDistance(r.plane, q, depth), dot(r.normal, n)) : 0.0;
}

#endif
