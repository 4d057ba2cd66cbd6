// SPDX-License-Identifier: MIT
// What the pixels of an interleaved cell know of their lights, packed into two texels with the geometry that the filter weighs it
// by: a neighbour costs two fetches.
#ifndef LIGHTSUMS_GLSL
#define LIGHTSUMS_GLSL

// num and den: sums over the pixel's lights, those it sees and all of them. lobe: the same two sums for the lobe.
struct LightSums {
    vec4 num;
    vec4 den;
    vec2 lobe;
};

// Where a pixel's sums are from. share: of the filter's weights that its neighbours have got.
struct SumsPlace {
    vec3 normal;
    float depth;
    float share;
};

uvec4 packSums(LightSums s)
{
    return uvec4(packHalf2x16(s.num.rg), packHalf2x16(s.num.ba), packHalf2x16(s.den.rg), packHalf2x16(s.den.ba));
}

uvec4 packPlace(SumsPlace p, vec2 lobe)
{
    return uvec4(packSnorm2x16(p.normal.xy), packSnorm2x16(vec2(p.normal.z, p.share)), floatBitsToUint(p.depth),
                 packHalf2x16(lobe));
}

LightSums unpackSums(uvec4 sums, uvec4 place)
{
    return LightSums(vec4(unpackHalf2x16(sums.x), unpackHalf2x16(sums.y)), vec4(unpackHalf2x16(sums.z), unpackHalf2x16(sums.w)),
                     unpackHalf2x16(place.w));
}

SumsPlace unpackPlace(uvec4 place)
{
    vec2 rest = unpackSnorm2x16(place.y);
    return SumsPlace(vec3(unpackSnorm2x16(place.x), rest.x), uintBitsToFloat(place.z), rest.y);
}

#endif
