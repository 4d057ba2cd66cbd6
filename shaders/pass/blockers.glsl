// SPDX-License-Identifier: MIT
// The light of the surfaces that block the map: the probes know it [pass/indirect.frag]; without them it is the picture's mean.
#ifndef BLOCKERS_GLSL
#define BLOCKERS_GLSL
#pragma import_defines(HAS_PROBES, HAS_BOUNCE)

#include "pass/meanradiance.glsl"

#if defined(HAS_PROBES) || defined(HAS_BOUNCE)
#define HAS_BLOCKERS
#endif
#ifdef HAS_PROBES
uniform sampler2D indirectMap;
uniform sampler2D mirroredMap;
#endif

#ifdef HAS_BLOCKERS
// The radiance that a white Lambert surface sends on of it. hidden: the share of directions that are blocked. scale: the probes' unit.
vec3 fromBlockers(ivec2 p, vec3 n, float hidden, float scale)
{
#ifdef HAS_PROBES
    return scale * texelFetch(indirectMap, p, 0).rgb;
#else
    return hidden * meanRadiance(n);
#endif
}

// Their mean radiance about the mirror direction d.
vec3 blockersAlong(ivec2 p, vec3 d, float scale)
{
#ifdef HAS_PROBES
    return scale * texelFetch(mirroredMap, p, 0).rgb;
#else
    return meanRadiance(d);
#endif
}
#endif

#endif
