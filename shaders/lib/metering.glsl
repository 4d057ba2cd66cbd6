// SPDX-License-Identifier: MIT
// Exposure by the light that a picture's surfaces receive, as a photographer's incident light meter has it: black things stay
// black and white ones white. The square of the mean root: lit parts count more than dark ones, but a small patch of sun alone
// does not decide.
#ifndef METERING_GLSL
#define METERING_GLSL

const float LEAST_METERED = 0.06;   // reflectance below which a surface tells nothing of the light on it: it may glow by itself
const float METERED_WHITE = 0.63;   // where mapExposure() shows white
const float LEAST_STOPS = -2.0;     // from there to where white may be shown: shade is darker than the open,
const float MOST_STOPS = 1.0;       // and a sun alone is that much brighter than its map's middle
const float MOST_ADAPTED = 16.0;    // stops, either way

// Weight of a surface in the mean, and that times the root of what a white one would send in its place.
// sent: luminance. A NaN or what is beyond all measure is not metered.
vec2 meteredLight(float sent, float reflectance)
{
    float white = max(sent, 0.0) / max(reflectance, LEAST_METERED);
    float weight = clamp(reflectance / LEAST_METERED - 1.0, 0.0, 1.0);
    return white < 1e30 ? weight * vec2(1.0, sqrt(white)) : vec2(0.0);
}

// Stops that bring white back to where it may be shown; stops0: the exposure before. sums: of meteredLight().
float meteredStops(vec2 sums, float stops0)
{
    float root = sums.y / sums.x;
    float shown = log2(max(root * root, 1e-30) / METERED_WHITE) + stops0;
    return clamp(clamp(shown, LEAST_STOPS, MOST_STOPS) - shown, -MOST_ADAPTED, MOST_ADAPTED);
}

#endif
