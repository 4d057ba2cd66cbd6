// SPDX-License-Identifier: MIT
// The G-buffer's outputs. Output 0 is the albedo with the surface's alpha, because the fixed-function alpha test reads it.
#ifndef FILLGBUFFER_GLSL
#define FILLGBUFFER_GLSL
#pragma import_defines(ENVLIGHT_LAMP, FOGGED)

#include "lib/anisotropy.glsl"
#include "lib/frame.glsl"
#include "lib/limits.glsl"
#include "lib/octahedral.glsl"
#include "lib/roughdiffuse.glsl"
#include "pass/surface.glsl"

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 specular;
layout(location = 3) out vec4 emission;

#ifdef ENVLIGHT_ANISOTROPY
// In the frame about the normal as it will be read: next to its seam, the normal itself may have the other.
float brushedAngle(Surface s)
{
    mat3 frame = frameAround(normalize(floor((0.5 * s.normal + 0.5) * 65535.0 + 0.5) / 65535.0 * 2.0 - 1.0));
    return dot(s.brushed, s.brushed) > 0.0 ? atan(dot(s.brushed, frame[1]), dot(s.brushed, frame[0])) : 0.0;
}
#endif

void fillGBuffer(Surface s)
{
    albedo = vec4(s.albedo, s.alpha);
    normal = vec4(0.5 * s.normal + 0.5, s.roughness);
    uint kind = packKind(s.brdf, packDiffuseRoughness(s.diffuseRoughness));
    specular.rgb = s.f0;
#ifdef ENVLIGHT_EDGE
    kind = packKind(s.brdf, packEdge(s.edge));
#endif
#ifdef ENVLIGHT_COAT
    albedo.rgb = s.baseColor;
    kind = packKind(BRDF_COATED, packCoat(s.coat));
    specular.rgb = vec3(s.metalness, octahedralFromDirection(s.coatNormal));
#endif
#ifdef ENVLIGHT_ANISOTROPY
    uint anisotropy = packAnisotropy(Anisotropy(s.anisotropy, brushedAngle(s)));
    if (anisotropy >= 256u) kind = packKind(BRDF_ANISOTROPIC, anisotropy);
#endif
    specular.a = float(kind) / 65535.0;
    emission = vec4(s.emission * exp2(-emittedStops), min(s.bulge, 0.49));  // in the units of display(), as emitted() has it
#if defined(ENVLIGHT_LIGHT) || defined(ENVLIGHT_LAMP)
    emission.a = LIGHT_MARK;
#endif
#ifdef FOGGED
    emission.a = -max(emission.a, LEAST_FOGGED);
#endif
}

#endif
