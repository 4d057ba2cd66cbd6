// SPDX-License-Identifier: MIT
#ifndef RADIANCESCALE_GLSL
#define RADIANCESCALE_GLSL

uniform float radianceScale;  // the map's mean radiance times its intensity: the unit of what passes keep

#endif
