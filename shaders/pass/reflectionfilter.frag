#version 330 compatibility
// SPDX-License-Identifier: MIT
// What glossy surfaces show of the picture, last part. The 4x4 pixels about each have rays in different directions of the lobe; their
// mean replaces the mean radiance of all that blocks light. The difference is added to the picture.
#pragma import_defines(HAS_FOG, KEEPS_REFLECTED, RAYS_MEET_ALL)

#include "pass/blockers.glsl"
#include "pass/lobeneighbours.glsl"
#include "pass/pixelfog.glsl"
#include "pass/toplight.glsl"
#include "pass/toplobe.glsl"

uniform sampler2D reflectionMap;
#ifdef RAYS_MEET_ALL
uniform sampler2D hiddenLobeMap;
#endif
#ifdef HAS_FOG
uniform sampler2D emissionMap;
#endif
uniform float radianceScale;

layout(location = 0) out vec4 change;
#ifdef KEEPS_REFLECTED
layout(location = 1) out vec4 sentByScene;  // for a still view's later frames
#endif

float brightness(vec3 c)
{
    return c.r + c.g + c.b;
}

// If one ray of a cell meets a lamp's highlight, the cell is a bright square. The brightest ray may therefore be at most this many times as
// bright as the brightest of three: the mean of the other rays that meet something, the map in the lobe, the scene's mean radiance. Metal
// balls at roughness .2 under studio, beside full light transport: tRMSE 7.50 % without a limit, 7.51 with 6, 7.52 with 3. With 6, one
// still sees squares.
const float MOST_OVER_OTHERS = 3.0;

// Mean of the rays of the 4x4 pixels about p. roughness: of the lobe; level: the largest of the map's and the scene's brightness in it.
vec4 cellMean(ivec2 p, float roughness, float level)
{
    LobeReceiver receiver = lobeReceiver(p);
    float narrowness = lobeNarrowness(roughness, SHARED_VISIBILITY_TURN);
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 sum = vec4(0.0);
    vec4 brightest = vec4(0.0);
    float all = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 to = ivec2(i & 3, i >> 2) - 2;
        ivec2 q = clamp(p + to, ivec2(0), last);
        float turn;
        float w = lobeNeighbour(receiver, q, length(vec2(to)), turn) * lobeWeight(turn, narrowness);
        vec4 ray = w * max(texelFetch(reflectionMap, q, 0), vec4(0.0));
        if (brightness(ray.rgb) > brightness(brightest.rgb)) brightest = ray;
        sum += ray;
        all += w;
    }
    vec4 others = sum - brightest;
    float most = MOST_OVER_OTHERS * max(brightness(others.rgb) / max(others.a, 1e-6), level) * brightest.a;
    sum.rgb -= brightest.rgb * max(1.0 - most / max(brightness(brightest.rgb), 1e-20), 0.0);
    return sum / max(all, 1e-6);
}

vec3 meanAbout(ivec2 p, vec3 n)
{
#ifdef HAS_BLOCKERS
    return blockersAlong(p, reflect(viewRay(inverseProjection, pixelNdc(p)), n), radianceScale);
#else
    return vec3(0.0);
#endif
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    TopLobe lobe = topLobe(p);
    float roughness = evenRoughness(lobe.bsdf);
    TopLight light = topLight(p);
    light.specular *= radianceScale;
    vec3 reflected = lobe.bsdf.reflected;
    vec3 mean = meanAbout(p, lobe.normal);
    float level = max(brightness(light.specular / max(reflected, vec3(1e-3))), brightness(mean));
    vec4 met = roughness < NARROW_ROUGHNESS ? texelFetch(reflectionMap, p, 0) : cellMean(p, roughness, level);
#ifdef RAYS_MEET_ALL
    float knownOpen = max(-met.w, 0.0);
    met.w = max(met.w, 0.0);
#endif
    float strength = 1.0 - smoothstep(TRACED_ROUGHNESS - 0.1, TRACED_ROUGHNESS, widestRoughness(lobe.bsdf));
    vec3 sent = reflected * (met.rgb + max(light.blocked.w - met.w, 0.0) * mean);
#ifdef RAYS_MEET_ALL
    // A ray that meets nothing knows better than lights about it: the lobe holds all that these take from it.
    sent = mix(sent, texelFetch(hiddenLobeMap, p, 0).rgb * radianceScale, knownOpen);
#endif
    // Rays that meet more than the maps know to be in the way hide the map, too.
    float open = min((1.0 - met.w) / max(1.0 - light.blocked.w, 1e-4), 1.0);
    vec3 before = light.blocked.rgb * mean;
    change = vec4(strength * ((open - 1.0) * light.specular + sent - before), 0.0);
#ifdef HAS_FOG
    change *= pixelFogLeaves(emissionMap, p);
#endif
#ifdef KEEPS_REFLECTED
    sentByScene = vec4(mix(before, sent, strength), 0.0);
#ifdef HAS_COATS
    if (isCoated(p)) sentByScene.rgb += texelFetch(blockedLobeMap, p, 0).rgb * meanAbout(p, pixelNormal(p));
#endif
#endif
}
