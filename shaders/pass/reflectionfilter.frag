#version 330 compatibility
// SPDX-License-Identifier: MIT
// What glossy surfaces show of the picture, last part. The 4x4 pixels about each have rays in different directions of the lobe; their
// mean replaces the mean radiance of all that blocks light. The difference is added to the picture.
#pragma import_defines(HAS_BOUNCE, KEEPS_REFLECTED)

#include "pass/lobeneighbours.glsl"
#ifdef HAS_BOUNCE
#include "pass/meanradiance.glsl"
#endif

uniform sampler2D reflectionMap;
uniform sampler2D specularTermMap;
uniform sampler2D blockedLobeMap;
uniform float radianceScale;

layout(location = 0) out vec4 change;
#ifdef KEEPS_REFLECTED
layout(location = 1) out vec4 sentByScene;  // for a still view's later frames
#endif

// Of the 4x4 pixels about p.
vec4 cellMean(ivec2 p)
{
    LobeReceiver receiver = lobeReceiver(p);
    float narrowness = lobeNarrowness(receiver.roughness, SHARED_VISIBILITY_TURN);
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 sum = vec4(0.0);
    float all = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 to = ivec2(i & 3, i >> 2) - 2;
        ivec2 q = clamp(p + to, ivec2(0), last);
        float turn;
        float w = lobeNeighbour(receiver, q, length(vec2(to)), turn) * lobeWeight(turn, narrowness);
        sum += w * texelFetch(reflectionMap, q, 0);
        all += w;
    }
    return sum / max(all, 1e-6);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    float roughness = texelFetch(normalMap, p, 0).a;
    vec4 met = roughness < NARROW_ROUGHNESS ? texelFetch(reflectionMap, p, 0) : cellMean(p);
    float strength = 1.0 - smoothstep(TRACED_ROUGHNESS - 0.1, TRACED_ROUGHNESS, roughness);
    vec3 reflected = pixelReflected(p);
    vec4 blocked = texelFetch(blockedLobeMap, p, 0);  // w: share
    vec3 mean = vec3(0.0);
#ifdef HAS_BOUNCE
    mean = meanRadiance(reflect(viewRay(inverseProjection, pixelNdc(p)), pixelNormal(p)));
#endif
    vec3 sent = reflected * (met.rgb + max(blocked.w - met.w, 0.0) * mean);
    // Rays that meet more than the maps know to be in the way hide the map, too.
    float open = min((1.0 - met.w) / max(1.0 - blocked.w, 1e-4), 1.0);
    vec3 specular = texelFetch(specularTermMap, p, 0).rgb * radianceScale;
    vec3 before = blocked.rgb * mean;
    change = vec4(strength * ((open - 1.0) * specular + sent - before), 0.0);
#ifdef KEEPS_REFLECTED
    sentByScene = vec4(mix(before, sent, strength), 0.0);
#endif
}
