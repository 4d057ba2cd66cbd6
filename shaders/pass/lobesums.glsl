// SPDX-License-Identifier: MIT
// What the filter averages for the lobe of a pixel, and how it is packed.
#ifndef LOBESUMS_GLSL
#define LOBESUMS_GLSL

// Sums over the pixel's group of the map's lights: flux times BRDF times cosine of those that it sees and of all, and their solid
// angle times the lobe, likewise.
struct LobeLights {
    vec3 seen;
    vec3 all;
    vec2 sky;
};

const float MOST_HALF = 6e4;

uvec4 packLobeLights(LobeLights s)
{
    vec3 seen = min(s.seen, vec3(MOST_HALF));
    vec3 all = min(s.all, vec3(MOST_HALF));
    return uvec4(packHalf2x16(seen.rg), packHalf2x16(vec2(seen.b, all.r)), packHalf2x16(all.gb), packHalf2x16(s.sky));
}

LobeLights unpackLobeLights(uvec4 texel)
{
    vec2 middle = unpackHalf2x16(texel.y);
    return LobeLights(vec3(unpackHalf2x16(texel.x), middle.x), vec3(middle.y, unpackHalf2x16(texel.z)), unpackHalf2x16(texel.w));
}

// What is seen of all: the share of the map's light in the lobe, by colour and by directions.
struct LobeSeen {
    vec3 light;
    float sky;
};

LobeSeen lobeSeen(LobeLights sums)
{
    float sky = sums.sky.y > 0.0 ? sums.sky.x / sums.sky.y : 1.0;
    vec3 light = vec3(sky);
    if (sums.all.r > 0.0) light.r = sums.seen.r / sums.all.r;
    if (sums.all.g > 0.0) light.g = sums.seen.g / sums.all.g;
    if (sums.all.b > 0.0) light.b = sums.seen.b / sums.all.b;
    return LobeSeen(light, sky);
}

#endif
