#version 330 compatibility
// SPDX-License-Identifier: MIT
// The light that a pixel gets from other surfaces, as the radiance that a white surface would send on of it. Where the pixel has a lobe,
// also their radiance about the mirror direction. In units of the map's mean. Alpha: the share of directions from which they send it.
#pragma import_defines(HAS_LOBES, HAS_BOUNCE, HAS_CAUSTICS)

#include "pass/gbuffer.glsl"
#include "pass/probegrid.glsl"
#include "pass/terms.glsl"
#ifdef HAS_BOUNCE
#include "pass/meanradiance.glsl"
#endif

#ifdef HAS_CAUSTICS
uniform sampler2D causticMap;  // mean over the groups of virtual lights
#endif
uniform mat4 atlasFromEye;  // to the probes' origin
uniform float probeShare;  // the rest is the mean radiance of what blocks light: the former answer goes over into this one

layout(location = 0) out vec4 received;
#ifdef HAS_LOBES
layout(location = 1) out vec4 mirrored;
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 n = pixelNormal(p);
    vec3 ray = viewRay(inverseProjection, pixelNdc(p));
    mat3 turn = mat3(atlasFromEye);
    vec3 normal = turn * n;
    ProbesAbout probes = probesAbout(vec3(atlasFromEye * vec4(pixelEye(p), 1.0)), normal, turn * -ray);
    float hidden = 1.0 - ambientVisibility(p);
    SentAbout sent = sentAbout(probes, normal);
    vec3 about = receivedFrom(sent, hidden);
#ifdef HAS_BOUNCE
    about = mix(hidden * meanRadiance(n) / radianceScale, about, probeShare);
#endif
#ifdef HAS_CAUSTICS
    about += float(LIGHT_GROUPS) * texelFetch(causticMap, p, 0).rgb;
#endif
    received = vec4(about, sendingShare(sent, hidden));
#ifdef HAS_LOBES
    mirrored = vec4(0.0);
    if (pixelBrdf(p) == BRDF_LAMBERT) return;
    vec3 top = n;
#ifdef HAS_COATS
    if (isCoated(p)) top = pixelCoatNormal(p);
#endif
    vec3 d = reflect(ray, top);
    vec3 along = sentAbout(probes, turn * d).radiance;
#ifdef HAS_BOUNCE
    along = mix(meanRadiance(d) / radianceScale, along, probeShare);
#endif
    mirrored = vec4(along, 1.0);
#endif
}
