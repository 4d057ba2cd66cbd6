#version 330 compatibility
// SPDX-License-Identifier: MIT
// Last part: the mean over the 4x4 pixels about each, whose rays have different directions, as far as their lobes are alike.
#include "pass/lobeneighbours.glsl"

uniform sampler2D rayChangeMap;
uniform sampler2D rayLightMap;

layout(location = 0) out vec4 reflected;

vec3 rayAt(ivec2 q)
{
    return texelFetch(rayChangeMap, q, 0).rgb + texelFetch(rayLightMap, q, 0).rgb;
}

vec3 cellMean(ivec2 p)
{
    LobeReceiver receiver = lobeReceiver(p);
    float narrowness = lobeNarrowness(receiver.roughness, SHARED_TURN);
    ivec2 last = ivec2(viewportSize) - 1;
    vec4 sum = vec4(0.0);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last);
            if (q != p + ivec2(x, y)) continue;
            float turn;
            float w = lobeNeighbour(receiver, q, length(vec2(x, y)), turn) * cellWeight(x, 2) * cellWeight(y, 2);
            sum += w * lobeWeight(turn, narrowness) * vec4(rayAt(q), 1.0);
        }
    return sum.rgb / max(sum.a, 1e-20);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 all = pixelReflected(p);
#ifdef HAS_COATS
    // The lobe of a coat is narrow.
    if (isCoated(p)) {
        reflected = vec4((all + pixelCoat(p).bsdf.reflected) * rayAt(p), 1.0);
        return;
    }
#endif
    reflected = vec4(all * cellMean(p), 1.0);
}
