// SPDX-License-Identifier: MIT
// Numbers that more than one function file needs.
#ifndef CONSTANTS_GLSL
#define CONSTANTS_GLSL

const float PI = 3.14159265358979323846;
const float TWO_PI = 6.28318530717958647693;
const float INV_PI = 0.31830988618379067154;

#endif
