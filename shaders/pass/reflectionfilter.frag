#version 330 compatibility
// SPDX-License-Identifier: MIT
// Last part: the rays of the 4x4 pixels about each, of which each takes another direction of the lobe, averaged as the lobes' other sums
// are; and what the picture's surfaces show in place of the mean radiance of all that blocks light. Added to the picture.
#pragma import_defines(HAS_BOUNCE, KEEPS_REFLECTED)

#include "lib/bilateral.glsl"
#include "pass/gbuffer.glsl"
#include "pass/albedo.glsl"
#include "pass/lobewidth.glsl"
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

vec4 cellMean(ivec2 p, vec4 surface)
{
    vec3 normal = normalize(surface.xyz * 2.0 - 1.0);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    PixelPlane plane = pixelPlane(eyeFromDepth(inverseProjection, ndc, depth), normal,
                                  1.5 * pixelFootprint(inverseProjection, ndc, depth, viewportSize));
    float narrowness = lobeNarrowness(surface.a, SHARED_VISIBILITY_TURN);
    float viewTurn = pixelTurn(ndc);
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 sum = vec4(0.0);
    float all = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 to = ivec2(i & 3, i >> 2) - 2;
        ivec2 q = clamp(p + to, ivec2(0), last);
        vec4 there = texelFetch(normalMap, q, 0);
        float z = texelFetch(depthMap, q, 0).r;
        vec3 n = there.xyz * 2.0 - 1.0;
        float w = z < 1.0 ? surfaceWeight(planeDistance(plane, q, z), dot(normal, n)) * lobeWeight(lobeTurn(normal - n, length(vec2(to)) * viewTurn), narrowness) *
                  alikeWeight(surface.a - there.a) : 0.0;
        sum += w * texelFetch(reflectionMap, q, 0);
        all += w;
    }
    return sum / max(all, 1e-6);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(normalMap, p, 0);
    bool isNarrow = surface.a < NARROW_ROUGHNESS;
    vec4 met = isNarrow ? texelFetch(reflectionMap, p, 0) : cellMean(p, surface);
    float strength = 1.0 - smoothstep(TRACED_ROUGHNESS - 0.1, TRACED_ROUGHNESS, surface.a);
    vec3 n = pixelNormal(p);
    vec3 ray = viewRay(inverseProjection, pixelNdc(p));
    vec3 reflected = bsdfOf(pixelBrdf(p), texelFetch(specularMap, p, 0).rgb, surface.a, max(-dot(n, ray), 1e-4)).reflected;
    vec4 blocked = texelFetch(blockedLobeMap, p, 0);  // w: share
    vec3 mean = vec3(0.0);
#ifdef HAS_BOUNCE
    mean = meanRadiance(reflect(ray, n));
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
