#version 330 compatibility
// SPDX-License-Identifier: MIT
// Second part of the light that surfaces close to a pixel send to it: the mean over a cell, whose 16 pixels trace rays in different
// directions. These surfaces fill a share of the directions. In that share the mean replaces the light of the probes.
#pragma import_defines(HAS_CAUSTICS)

#include "pass/cellmean.glsl"
#ifdef HAS_CAUSTICS
#include "lib/limits.glsl"
uniform sampler2D causticMap;  // mean over the groups of virtual lights
#endif

uniform sampler2D probeLightMap;  // of pass/indirect.frag
uniform sampler2D nearLightMap;
uniform float probeShare;  // of what probes and points say; the rest is the mean radiance of what blocks light

layout(location = 0) out vec4 received;

// Most pixels of many pictures have nothing near.
bool hasNear(ivec2 p)
{
    ivec2 last = ivec2(viewportSize) - 1;
    float sum = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) sum += texelFetch(nearLightMap, clamp(p + ivec2(x, y), ivec2(0), last), 0).a;
    return sum > 0.0;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 probes = texelFetch(probeLightMap, p, 0);
    bool any = hasNear(p);
    // Some hardware evaluates both sides of the condition. With -1 the loops of the mean make no turn there.
    vec4 near = any ? cellMean(nearLightMap, p, any ? 2 : -1) : vec4(0.0);
    float far = max(probes.a - near.a, 0.0) / max(probes.a, 1e-4);
    received = vec4(mix(probes.rgb, far * probes.rgb + near.rgb, probeShare), 1.0);
#ifdef HAS_CAUSTICS
    received.rgb += float(LIGHT_GROUPS) * texelFetch(causticMap, p, 0).rgb;
#endif
}
