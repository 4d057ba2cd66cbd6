#version 330 compatibility
// SPDX-License-Identifier: MIT
// First surface from a light: its depth and slope. Second surface: the depth of the nearest that is not the first. Alpha goes
// out for the fixed-function alpha test.
#extension GL_ARB_conservative_depth : enable
#pragma import_defines(CASTER_ALPHA, CASTER_BLENDED, CASTER_FLOORS_FIRST, CASTER_PERSPECTIVE, CASTER_SECOND)

#include "lib/emittermap.glsl"
#include "lib/sequence.glsl"
#include "pass/casteralpha.glsl"

#ifdef CASTER_SECOND
uniform sampler2D firstDepthMap;
#endif
#ifdef CASTER_PERSPECTIVE
uniform float mapTexel;  // its width at distance 1
#endif
#ifdef CASTER_BLENDED
uniform ivec2 atlasMapIndex;
#endif

#if defined(CASTER_FLOORS_FIRST) && defined(GL_ARB_conservative_depth)
layout(depth_greater) out float gl_FragDepth;
#endif
layout(location = 0) out vec4 surface; // slope, negative for sheets: leaves, grilles and what shows its back; second: 1 if that; the slope's turn

void main()
{
    float alpha = casterAlpha();
#ifdef CASTER_BLENDED
    // Blocks this share of the texels, others in each light's map.
    float threshold = (float(bayer4(int(gl_FragCoord.x), int(gl_FragCoord.y))) + 0.5) / 16.0;
    if (alpha <= fract(threshold + 0.61803399 * float(atlasMapIndex.x))) discard;
    alpha = 1.0;
#endif
#ifdef CASTER_SECOND
    float first = texelFetch(firstDepthMap, ivec2(gl_FragCoord.xy), 0).r;
#ifdef CASTER_PERSPECTIVE
    float step = EMITTER_MAP_STEP * mapTexel * (1.0 - first);
#else
    float step = ATLAS_STEP;
#endif
    if (gl_FragCoord.z <= first + step) discard;
    surface = vec4(0.0, gl_FrontFacing ? 0.0 : 1.0, 0.0, alpha);
#else
    vec2 gradient = -vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)); // heights are one less depths
    float slope = length(gradient);
    if (!gl_FrontFacing) slope = -slope;
#ifdef CASTER_ALPHA
    slope = -abs(slope);
#endif
    surface = vec4(slope, 0.0, turnOf(gradient), alpha);
#ifdef CASTER_FLOORS_FIRST
    // Of two surfaces at one place the one that shows its back is first: from below, the floor before what stands on it.
    gl_FragDepth = gl_FragCoord.z + (gl_FrontFacing ? 0.5 * ATLAS_STEP : 0.0);
#endif
#endif
}
