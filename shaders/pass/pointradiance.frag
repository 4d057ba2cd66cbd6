#version 330 compatibility
// SPDX-License-Identifier: MIT
// Surface points send on a share of the light that they receive: from the map, and from each other. The probes know the latter as they
// were a bounce ago, so each draw adds a bounce [indirect.md 4]. What is closer than the next probe is known by links from point to point.
// The light can't grow without end: of the others' light a point takes no more than the share of directions in which it does not see the
// map.
#pragma import_defines(HAS_EMISSION, HAS_GLOSS, HAS_POINT_LINKS, FIRST_BOUNCE)

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
#ifdef HAS_POINT_LINKS
uniform sampler2D pointNearMap;  // of pass/pointnear.frag
#endif
uniform float radianceScale;

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(pointLightMap, p, 0);
    vec3 fromSurfaces = vec3(0.0);
#ifndef FIRST_BOUNCE
    vec3 n = texelFetch(pointNormalMap, p, 0).xyz;
    SentAbout sent = sentAbout(probesAbout(texelFetch(pointPlaceMap, p, 0).xyz, n, n), n);
    float hidden = 1.0 - light.a;
    float share = sendingShare(sent, hidden);
#ifdef HAS_POINT_LINKS
    vec4 near = texelFetch(pointNearMap, p, 0);
    near *= min(1.0, hidden / max(near.a, 1e-20));
    fromSurfaces = near.rgb;
    share = max(share - near.a, 0.0);
#endif
    fromSurfaces += share * sent.radiance;
#endif
    vec3 sentOn = texelFetch(pointDiffuseMap, p, 0).rgb * (light.rgb + fromSurfaces);
#ifdef HAS_GLOSS
    vec4 mirrored = texelFetch(pointMirroredMap, p, 0);
    sentOn += texelFetch(pointGlossyMap, p, 0).rgb * (mirrored.rgb + mirrored.a * fromSurfaces);
#endif
#ifdef HAS_EMISSION
    sentOn += texelFetch(pointEmissionMap, p, 0).rgb * (emittedScale() / radianceScale);
#endif
    radiance = vec4(sentOn, 1.0);
}
