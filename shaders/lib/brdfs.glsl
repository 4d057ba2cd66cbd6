// SPDX-License-Identifier: MIT
// The numbers by which the G-buffer names the BRDFs.
#ifndef BRDFS_GLSL
#define BRDFS_GLSL

#define BRDF_LAMBERT 0
#define BRDF_PHONG 1
#define BRDF_COOK_TORRANCE 2  // with GGX's distribution
#define BRDF_BLINN_PHONG 3
#define BRDF_BECKMANN 4       // Cook-Torrance with Beckmann's distribution
#define BRDF_STRAUSS 5
#define BRDF_COATED 6         // Cook-Torrance with GGX below a clear coat

#endif
