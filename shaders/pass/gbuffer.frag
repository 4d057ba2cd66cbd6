#version 330 compatibility
// SPDX-License-Identifier: MIT
// Fills the G-buffer. Output 0 is the albedo with the surface's alpha, because the fixed-function alpha test reads it.

#include "lib/octahedral.glsl"
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
    uint kind = uint(s.brdf) << 8;
    specular.rgb = s.f0;
#ifdef ENVLIGHT_COAT
    albedo.rgb = s.baseColor;
    uint coat = packCoat(s.coat);
    kind = uint(BRDF_COATED) << 8 | coat >> 8 << 11 | coat & 255u;
    specular.rgb = vec3(s.metalness, octahedralFromDirection(s.coatNormal));
#endif
    specular.a = float(kind) / 65535.0;
    emission = vec4(s.emission * exp2(-emittedStops), min(s.bulge, 0.49));  // in the units of display(), as emitted() has it
}
