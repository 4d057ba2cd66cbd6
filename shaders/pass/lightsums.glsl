// SPDX-License-Identifier: MIT
// The sums over a pixel's lights, and the surface there, by which the filter weighs neighbours: packed into two texels.
#ifndef LIGHTSUMS_GLSL
#define LIGHTSUMS_GLSL

#include "lib/octahedral.glsl"

// num and den: sums over the pixel's lights, those it sees and all of them.
struct LightSums {
    vec4 num;
    vec4 den;
};

// Where a pixel's sums are from. facet: normal of the plane about it.
struct SumsPlace {
    vec3 normal;
    vec3 facet;
    float depth;
};

// 16 bits: 0 if it is the surface's normal, else to half a degree.
uint packFacet(vec3 facet, vec3 normal)
{
    uvec2 st = uvec2(octahedralFromDirection(facet) * 254.0 + 1.5);
    return facet == normal ? 0u : st.x << 8 | st.y;
}

vec3 unpackFacet(uint code, vec3 normal)
{
    vec2 st = (vec2(float(code >> 8), float(code & 0xffu)) - 1.0) / 254.0;
    return code == 0u ? normal : directionFromOctahedral(st);
}

uvec4 packSums(LightSums s)
{
    return uvec4(packHalf2x16(s.num.rg), packHalf2x16(s.num.ba), packHalf2x16(s.den.rg), packHalf2x16(s.den.ba));
}

uvec4 packPlace(SumsPlace p)
{
    uint z = packSnorm2x16(vec2(p.normal.z, 0.0)) | packFacet(p.facet, p.normal) << 16;
    return uvec4(packSnorm2x16(p.normal.xy), z, floatBitsToUint(p.depth), 0u);
}

LightSums unpackSums(uvec4 sums)
{
    return LightSums(vec4(unpackHalf2x16(sums.x), unpackHalf2x16(sums.y)), vec4(unpackHalf2x16(sums.z), unpackHalf2x16(sums.w)));
}

SumsPlace unpackPlace(uvec4 place)
{
    vec3 normal = vec3(unpackSnorm2x16(place.x), unpackSnorm2x16(place.y).x);
    return SumsPlace(normal, unpackFacet(place.y >> 16, normal), uintBitsToFloat(place.z));
}

#endif
