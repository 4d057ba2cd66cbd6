// SPDX-License-Identifier: MIT
// The BRDF's number in the G-buffer.
#ifndef BRDF_GLSL
#define BRDF_GLSL

#define BRDF_LAMBERT 0
#define BRDF_PHONG 1
#define BRDF_COOK_TORRANCE 2

#endif
