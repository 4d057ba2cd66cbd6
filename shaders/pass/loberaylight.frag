#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// Second part: what the surface that a lobe's ray meets sends back along it.
#include "lib/octahedral.glsl"
#include "lib/sharedexponent.glsl"
#include "pass/pathlight.glsl"
#include "pass/raysurface.glsl"

// Of the first part.
uniform sampler2D rayPlaceMap;
uniform usampler2D raySurfaceMap;

layout(location = 0) out vec4 light;  // over the pixel's reflectance

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    light = vec4(0.0);
    vec4 place = texelFetch(rayPlaceMap, p, 0);
    if (place.a <= 0.0) return;
    uvec4 code = texelFetch(raySurfaceMap, p, 0);
    TracedLayers layers = tracedLayers(packedSurface(place.a));
    layers.diffuse = unpackSharedExponent(code.z);
    PathSurface s = PathSurface(place.xyz, directionFromOctahedral(unpackUnorm2x16(code.x)),
                                -directionFromOctahedral(unpackUnorm2x16(code.y)), layers);
    vec3 sent = pathLight(s, packedRoughness(place.a), 0, rayPixel(p), 0x20000000u + uint(sampleFrames));
    light = vec4(radianceScale * unpackSharedExponent(code.w) * sent, 1.0);
}
