// SPDX-License-Identifier: MIT
// The end of the post-process chain: tone curves and the display's encoding. Scene-linear Rec.709 in, [0,1] out.
#ifndef TONE_GLSL
#define TONE_GLSL

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// Reinhard 2002, eq. 3, on luminance: keeps hue and saturation.
vec3 toneReinhard(vec3 c)
{
    return c / (1.0 + luminance(c));
}

// Colours below .76 as they are, highlights bent to white: Khronos PBR Neutral's shoulder without its toe.
vec3 toneShoulder(vec3 c)
{
    float start = 0.76;
    float peak = max(c.x, max(c.y, c.z));
    if (peak < start) return c;
    float room = 1.0 - start;
    float newPeak = 1.0 - room * room / (peak + room - start);
    float white = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
    return mix(c * (newPeak / peak), vec3(newPeak), white);
}

// Khronos PBR Neutral 2024: the 4 % of Fresnel that every glossy surface adds to its colour are taken off before.
vec3 toneNeutral(vec3 c)
{
    float x = min(c.x, min(c.y, c.z));
    float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    return toneShoulder(c - offset);
}

// IEC 61966-2-1, one channel, and back.
float srgbEncode(float x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

float srgbDecode(float x)
{
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

vec3 srgbEncode3(vec3 c)
{
    return vec3(srgbEncode(c.x), srgbEncode(c.y), srgbEncode(c.z));
}

vec3 srgbDecode3(vec3 c)
{
    return vec3(srgbDecode(c.x), srgbDecode(c.y), srgbDecode(c.z));
}

// Colours that people type as display values: above 1, where no display has a curve, a number is light itself.
float typedEncode(float x)
{
    return x > 1.0 ? x : srgbEncode(max(x, 0.0));
}

float typedDecode(float x)
{
    return x > 1.0 ? x : srgbDecode(max(x, 0.0));
}

vec3 typedDecode3(vec3 c)
{
    return vec3(typedDecode(c.x), typedDecode(c.y), typedDecode(c.z));
}

#endif
