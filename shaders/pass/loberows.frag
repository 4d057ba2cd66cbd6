#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// S, second part: the sums of the lobes filtered along rows.
#include "pass/lobefilter.glsl"

#ifdef PREFILTERED
layout(location = 0) out uvec4 lobeLights;
#else
layout(location = 0) out vec4 estimate;
#ifdef HAS_LOBE_LIGHTS
layout(location = 1) out uvec4 lobeLights;
#endif
#endif

void main()
{
    LobeSums sums = filteredLobes(ivec2(gl_FragCoord.xy), ivec2(1, 0));
#ifndef PREFILTERED
    estimate = sums.estimate;
#endif
#ifdef HAS_LOBE_LIGHTS
    lobeLights = packLobeLights(sums.lights);
#endif
}
