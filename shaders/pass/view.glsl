// SPDX-License-Identifier: MIT
// The numbers of the property `view` of Settings.
#ifndef VIEW_GLSL
#define VIEW_GLSL

#define VIEW_BEAUTY 0
#define VIEW_DIFFUSE 1
#define VIEW_SPECULAR 2
#define VIEW_OCCLUSION 3
#define VIEW_VISIBILITY 4
#define VIEW_ALBEDO 5
#define VIEW_NORMAL 6
#define VIEW_DEPTH 7
#define VIEW_EMISSION 8
#define VIEW_BOUNCE 9
#define VIEW_LIGHTS 10

#endif
