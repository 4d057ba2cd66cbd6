// SPDX-License-Identifier: MIT
// Low-discrepancy points and the order of the pixels in an interleaved cell.
#ifndef SEQUENCE_GLSL
#define SEQUENCE_GLSL

// Van der Corput's radical inverse in base 2, in [0,1). 24 bits only: a float holds them exactly, 32 would round to 1.
float radicalInverse(uint i)
{
    i = (i << 16u) | (i >> 16u);
    i = ((i & 0x00ff00ffu) << 8u) | ((i & 0xff00ff00u) >> 8u);
    i = ((i & 0x0f0f0f0fu) << 4u) | ((i & 0xf0f0f0f0u) >> 4u);
    i = ((i & 0x33333333u) << 2u) | ((i & 0xccccccccu) >> 2u);
    i = ((i & 0x55555555u) << 1u) | ((i & 0xaaaaaaaau) >> 1u);
    return float(i >> 8u) / 16777216.0;
}

// Point i of n of the Hammersley set, centred in its strata, in (0,1)^2.
vec2 hammersley(uint i, uint n)
{
    return vec2((float(i) + 0.5) / float(n), radicalInverse(i) + 0.5 / float(n));
}

// Point i of Sobol's sequence in two dimensions, in [0,1)^2. 2^m points that follow each other from a multiple of 2^m on are a (0,m,2)-net:
// halve the square m times along either axis, and each of the rectangles holds one point [Kollig, Keller 2002].
vec2 sobolPoint(uint i)
{
    uint other = 0u;
    uint bit = 0x80000000u;
    for (uint rest = i; rest != 0u; rest >>= 1u) {
        if ((rest & 1u) == 1u) other ^= bit;
        bit ^= bit >> 1u;
    }
    return vec2(radicalInverse(i), float(other >> 8u) / 16777216.0);
}

// Sample j of n in [0,1)^2. pixel: its number, 0 .. 15, in its 4x4 cell. The n points of a pixel are a lattice of low discrepancy. So are
// the 16 n points of a cell: for n = 4 .. 32 their discrepancy is that of Hammersley's sets. With .618 in place of 3.618 it is not.
vec2 cellPoint(int j, float pixel, int n)
{
    float i = float(j) + pixel / 16.0;
    return vec2(i / float(n), fract(3.6180340 * i));
}

// Bayer's number 0..15 of a pixel in its 4x4 cell: near numbers lie far apart.
int bayer4(int x, int y)
{
    int a = (x ^ y) & 1;
    int b = (y & 1);
    int c = ((x ^ y) >> 1) & 1;
    int d = (y >> 1) & 1;
    return a * 8 + b * 4 + c * 2 + d;
}

// A number of two whole ones, in [0,1): those of pixels side by side have nothing in common. [Jarzynski, Olano 2020, pcg]
float pixelNumber(uint x, uint y)
{
    uint state = (x * 1664525u + y) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return float(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}

#endif
