// SPDX-License-Identifier: MIT
// What a picture that is averaged over frames knows of each pixel beside its colour.
#ifndef HISTORY_GLSL
#define HISTORY_GLSL

const int HISTORY_FRAMES = 8;  // at most 15: the last one's share of a picture is 1 / that

// Distance before the eye, and in how many frames the surface was seen: in the lowest four bits.
float packPlace(float distance, int age)
{
    return uintBitsToFloat((floatBitsToUint(distance) & 0xFFFFFFF0u) | uint(age));
}

int placeAge(float place)
{
    return int(floatBitsToUint(place) & 15u);
}

#endif
