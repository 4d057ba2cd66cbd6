// SPDX-License-Identifier: MIT
// The numbers by which the G-buffer names the BRDFs.
#ifndef BRDFS_GLSL
#define BRDFS_GLSL

#define BRDF_LAMBERT 0
#define BRDF_PHONG 1
#define BRDF_COOK_TORRANCE 2

#endif
