// SPDX-License-Identifier: MIT
// The map's radiance in a direction, in units of its mean.
#ifndef MAPLIGHT_GLSL
#define MAPLIGHT_GLSL

#include "lib/latlong.glsl"
#include "lib/octahedral.glsl"

uniform sampler2D pyramidMap;
uniform sampler2D latlongMap;
uniform float pyramidSide;
uniform float pyramidLastLevel;

// Below this alpha one look-up at the map's own resolution is the lobe: a texel of a 1024-wide map is wider.
const float MIRROR_ALPHA = 0.0009;

vec3 mirror(vec3 d)
{
    return textureLod(latlongMap, latlongFromDirection(d), 0.0).rgb;
}

vec3 filtered(vec3 d, float lod)
{
    return pyramidLookup(pyramidMap, pyramidSide, pyramidLastLevel, d, lod);
}

// The level of the pyramid whose texels are as wide as one of so many samples at density 1; half the density's log2 finer is right.
float lodOfUnitDensity(float samples)
{
    return log2(pyramidSide) - 0.5 * log2(4.0 * PI * samples);
}

#endif
