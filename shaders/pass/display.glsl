// SPDX-License-Identifier: MIT
// From scene-linear radiance to what the host draws to.
#ifndef DISPLAY_GLSL
#define DISPLAY_GLSL
#pragma import_defines(OUTPUT_LINEAR, ADAPTED)

#include "lib/sequence.glsl"
#include "lib/tone.glsl"

#define TONE_CLIP 0
#define TONE_REINHARD 1
#define TONE_NEUTRAL 2
#define TONE_SHOULDER 3

uniform int toneCurve;
uniform float baseStops; // what the map is shown at, by exposureBase
uniform float exposure;  // stops
uniform int dither;
#ifdef ADAPTED
uniform sampler2D adaptedStopsMap;
#endif

// Stops that are added to baseStops and exposure. Unlit surfaces get none: they are shown as they were typed.
float adaptedStops()
{
#ifdef ADAPTED
    return texelFetch(adaptedStopsMap, ivec2(0), 0).r;
#else
    return 0.0;
#endif
}

// What a display is sent.
vec3 displayValues(vec3 radiance, float adapted)
{
    vec3 c = max(radiance, vec3(0.0)) * exp2(baseStops + exposure + adapted);
    c = min(c, vec3(1e30)); // Inf / Inf
    if (toneCurve == TONE_REINHARD) c = toneReinhard(c);
    if (toneCurve == TONE_NEUTRAL) c = toneNeutral(c);
    if (toneCurve == TONE_SHOULDER) c = toneShoulder(c);
    return srgbEncode3(clamp(c, 0.0, 1.0));
}

vec3 dithered(vec3 c, ivec2 p)
{
    return dither != 0 ? c + (float(bayer4(p.x, p.y)) - 7.5) / (16.0 * 255.0) : c;
}

vec3 display(vec3 radiance, float adapted, ivec2 p)
{
#ifdef OUTPUT_LINEAR
    return radiance;
#else
    return dithered(displayValues(radiance, adapted), p);
#endif
}

#endif
