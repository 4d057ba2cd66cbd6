#version 330 compatibility
// SPDX-License-Identifier: MIT
// Surface points send on a share of the light that they receive: from the map, and from each other. The probes know the latter as they
// were a bounce ago, so each draw adds a bounce [indirect.md 4]. The light can't grow without end: of the others' light a point takes no
// more than the share of directions in which it does not see the map.
#pragma import_defines(HAS_EMISSION, HAS_GLOSS, FIRST_BOUNCE)

#include "pass/hostcolor.glsl"
#ifndef FIRST_BOUNCE
#include "pass/probegrid.glsl"
#endif

uniform sampler2D pointPlaceMap;
uniform sampler2D pointNormalMap;
uniform sampler2D pointLightMap;
uniform sampler2D pointDiffuseMap;
#ifdef HAS_GLOSS
uniform sampler2D pointGlossyMap;
uniform sampler2D pointMirroredMap;
#endif
uniform sampler2D pointEmissionMap;
uniform float radianceScale;

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(pointLightMap, p, 0);
    vec3 fromSurfaces = vec3(0.0);
#ifndef FIRST_BOUNCE
    vec3 n = texelFetch(pointNormalMap, p, 0).xyz;
    fromSurfaces = receivedFrom(sentAbout(probesAbout(texelFetch(pointPlaceMap, p, 0).xyz, n, n), n), 1.0 - light.a);
#endif
    vec3 sent = texelFetch(pointDiffuseMap, p, 0).rgb * (light.rgb + fromSurfaces);
#ifdef HAS_GLOSS
    vec4 mirrored = texelFetch(pointMirroredMap, p, 0);
    sent += texelFetch(pointGlossyMap, p, 0).rgb * (mirrored.rgb + mirrored.a * fromSurfaces);
#endif
#ifdef HAS_EMISSION
    sent += texelFetch(pointEmissionMap, p, 0).rgb * (emittedScale() / radianceScale);
#endif
    radiance = vec4(sent, 1.0);
}
