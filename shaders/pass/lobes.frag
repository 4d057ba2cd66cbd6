#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// S, last part: the rows' sums filtered along columns. The map's radiance in the lobe is a ratio of two sums, so that an even map is
// reflected exactly. What the scene leaves of it is a ratio of sums over lights, one for each colour [specular.md 4]. Suns and coats are added.
// LOBES_SHARP: a still view's later frames average over time instead. The first one's share is a beginning that they correct.
#pragma import_defines(HAS_SUNS, LOBES_SHARP, HAS_SHOWN, KEEPS_SHOWN, KEEPS_HIDDEN, MAP_IS_BLACK)

#include "pass/lobefilter.glsl"
#include "pass/lobeshown.glsl"

#ifdef HAS_SUNS
uniform sampler2D sunGlintMap;
#endif
#ifdef HAS_SHOWN
uniform sampler2D shownMap;
#endif
#ifdef HAS_COATS
uniform sampler2D coatTermMap;
#endif

layout(location = 0) out vec4 specular;
#ifdef HAS_LOBE_LIGHTS
layout(location = 1) out vec4 blockedLobe;  // rgb: the lobe's albedo times alpha, the share of the map that surfaces hide
#ifdef KEEPS_HIDDEN
layout(location = 2) out vec4 hiddenLobe;  // what the scene takes from S, as far as lights tell
#endif
#ifdef KEEPS_SHOWN
#ifdef KEEPS_HIDDEN
layout(location = 3) out vec4 shownLobe;
#else
layout(location = 2) out vec4 shownLobe;
#endif
#endif
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 reflected = pixelReflected(p);
    vec3 shown = vec3(1.0);
    vec4 estimate = vec4(0.0);
#if !defined(MAP_IS_BLACK) && (defined(LOBES_SHARP) || defined(PREFILTERED))
    estimate = texelFetch(estimateMap, p, 0);
#endif
#ifdef LOBES_SHARP
#ifdef HAS_SHOWN
    shown = texelFetch(shownMap, p, 0).rgb;
#endif
    float code = packShown(shown);
    shown = unpackShown(code);
#else
    LobeSums sums = filteredLobes(p, ivec2(0, 1));
#ifndef PREFILTERED
    estimate = sums.estimate;
#endif
#ifdef HAS_LOBE_LIGHTS
    LobeSeen seen = lobeSeen(sums.lights);
    shown = seen.light;
    blockedLobe = (1.0 - seen.sky) * vec4(reflected, 1.0);
#ifdef KEEPS_SHOWN
    shownLobe = vec4(shown, 1.0);
#endif
#endif
#endif
    vec3 mean = estimate.a > 0.0 ? estimate.rgb / estimate.a : vec3(0.0);
    specular = vec4(mean * shown * reflected, 1.0);
#ifdef LOBES_SHARP
    specular.a = code;
#endif
#if defined(HAS_LOBE_LIGHTS) && defined(KEEPS_HIDDEN)
    hiddenLobe = vec4(mean * (1.0 - shown) * reflected, 1.0);
#endif
#ifdef HAS_SUNS
    specular.rgb += texelFetch(sunGlintMap, p, 0).rgb;
#endif
#ifdef HAS_COATS
    specular.rgb += texelFetch(coatTermMap, p, 0).rgb;
#endif
}
