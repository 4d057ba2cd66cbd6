// SPDX-License-Identifier: MIT
// How far the smooth surface that interpolated normals stand for lies above its facet [length]: a shadow map of facets, asked
// from there, does not shade the facets about a terminator [Hanika 2021 asks from tangent planes at the corners; here one
// corner and the curvature stand for all three].
// The body's other facets rise above the tangent plane at a point of a facet by no more than this.
#ifndef BULGE_GLSL
#define BULGE_GLSL

// Corners whose normals lean further from the facet's (sine) are those of bodies of fewer than some 16 sides: traced facets shade
// themselves there (a spider's legs), and edges that were smoothed over are no round bodies.
const float BULGE_MOST_LEAN = 0.3;

// Normals that differ by less (sine) are those of a plane, whose curvature would be rounding.
const float BULGE_LEAST_TURN = 0.005;

// All unit vectors on one side of the facet. 0 where the surface is flat, hollow or has an edge.
float bulgeAbove(vec3 facet, vec3 point, vec3 normal, vec3 corner, vec3 cornerNormal)
{
    vec3 turn = normal - cornerNormal;
    float along = dot(turn, point - corner);  // negative in a hollow
    float turn2 = dot(turn, turn);
    if (along <= 0.0 || turn2 <= BULGE_LEAST_TURN * BULGE_LEAST_TURN) return 0.0;
    float curvature = turn2 / along;  // in the direction in which the normals turn: right for cylinders, too
    vec3 lean = cornerNormal - dot(cornerNormal, facet) * facet;
    vec3 here = normal - dot(normal, facet) * facet;
    float most = dot(lean, lean);
    float fade = clamp((BULGE_MOST_LEAN - sqrt(most)) / (0.4 * BULGE_MOST_LEAN), 0.0, 1.0) *
                 clamp(sqrt(turn2) / BULGE_LEAST_TURN - 1.0, 0.0, 1.0);
    // A sphere of that curvature through the corners: (L^2 - d^2) curvature / 2.
    return fade * max(most - dot(here, here), 0.0) / (2.0 * curvature);
}

// The part of the bulge that counts under a sun. up: sine of the sun's height over the tangent plane. A facet hides another only
// from a sun that is lower than the angle between the two. That angle is at most twice the lean of the corners.
float bulgeUnderSun(float bulge, float up)
{
    return bulge * clamp(3.0 - up / (0.6 * BULGE_MOST_LEAN), 0.0, 1.0);
}

#endif
