#version 330 compatibility
// SPDX-License-Identifier: MIT
// Second step: the stops that are added to the map's exposure. They follow the light on what the picture shows, in time.
#pragma import_defines(HISTORY)

#include "lib/limits.glsl"
#include "lib/metering.glsl"

uniform sampler2D meteredMap;
uniform float baseStops;
#ifdef HISTORY
uniform sampler2D formerStopsMap;
uniform float adaptedShare;  // of the way from there
#endif

layout(location = 0) out float stops;

void main()
{
    vec2 sums = vec2(0.0);
    for (int y = 0; y < METER_SIDE; ++y)
        for (int x = 0; x < METER_SIDE; ++x) sums += texelFetch(meteredMap, ivec2(x, y), 0).rg;
    float former = 0.0;
#ifdef HISTORY
    former = texelFetch(formerStopsMap, ivec2(0), 0).r;
#endif
    stops = former;
    if (sums.x <= 0.0) return;  // nothing that light falls on is in view
    stops = meteredStops(sums, baseStops);
#ifdef HISTORY
    stops = mix(former, stops, adaptedShare);
#endif
}
