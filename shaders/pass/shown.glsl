// SPDX-License-Identifier: MIT
// The radiance that is shown: of the frame, or of a still view's average.
#ifndef SHOWN_GLSL
#define SHOWN_GLSL
#pragma import_defines(ACCUMULATED, HAS_UNLIT)

#include "pass/display.glsl"
#ifdef HAS_UNLIT
#include "pass/gbuffer.glsl"
#endif

uniform sampler2D radianceMap;
#ifdef ACCUMULATED
uniform sampler2D accumulatedMap;  // weighted sum of all frames of a still view but the first, whose radiance radianceMap is
uniform float accumulatedWeight;
uniform float accumulatedShare;    // of the average in what is shown
#endif

// Alpha: 1 where there is a surface.
vec4 shownPicture(ivec2 p)
{
    vec4 picture = texelFetch(radianceMap, p, 0);
#ifdef ACCUMULATED
    picture = mix(picture, texelFetch(accumulatedMap, p, 0) / accumulatedWeight, accumulatedShare);
#endif
    return picture;
}

// For display()
float shownStops(ivec2 p)
{
#ifdef HAS_UNLIT
    if (isUnlit(kindBrdf(pixelKind(p)), texelFetch(normalMap, p, 0).a)) return 0.0;
#endif
    return adaptedStops();
}

#endif
