#version 330 compatibility
// SPDX-License-Identifier: MIT
// Fills the G-buffer. Output 0 is the albedo with the surface's alpha, because the fixed-function alpha test reads it.

#include "pass/surface.glsl"

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 specular;
layout(location = 3) out vec4 emission;

void main()
{
    Surface s = readSurface();
    albedo = vec4(s.albedo, s.alpha);
    normal = vec4(0.5 * s.normal + 0.5, s.roughness);
    specular = vec4(s.f0, float(s.brdf) / 255.0);
    emission = vec4(s.emission * exp2(-emittedStops), min(s.bulge, 0.49));  // in the units of display(), as emitted() has it
}
