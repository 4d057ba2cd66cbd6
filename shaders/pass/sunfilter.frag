#version 330 compatibility
// SPDX-License-Identifier: MIT
// What each pixel sees of the suns, last part: in penumbrae. It asks 16 points of the disc. Neighbours add their one point each
// where the penumbra is wider than their distance, so contact shadows stay sharp.
#include "lib/bilateral.glsl"
#include "pass/sunpoints.glsl"

layout(location = 0) out vec4 visibility0;
layout(location = 1) out vec4 visibility1;

float visibilityOf(int sun, ivec2 p)
{
    ivec2 last = ivec2(viewportSize) - 1;
    float own = seenAt(sun, p).x;
    SunAround around = sunAround(sun, p, own, last);
    if (around.even) return own;
    SunPixel s = sunPixel(p);
    vec2 sum = 16.0 * vec2(sunSeen(sun, s, 16).x, 1.0);
    float reach = clamp(0.15 * around.width.x / max(around.width.y, 1e-6), 0.0, 2.0);
    if (reach <= 0.5) return sum.x / sum.y;
    vec3 n = pixelNormal(p);
    vec3 eye = pixelEye(p);
    PixelPlane plane = pixelPlane(eye, pixelFacet(p, eye, n, s.footprint), 1.5 * s.footprint);
    // Pixels that do not face the sun have not asked whether it is hidden.
    vec3 towards = sunAxes[3 * sun + 2] * mat3(atlasFromEye);
    float faces = -tan(sunRadius[sun]);
    int most = reach > 1.5 ? 2 : 1;
    for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; ++x) {
            ivec2 q = p + ivec2(x, y);
            float w = clamp(reach + 0.5 - float(max(abs(x), abs(y))), 0.0, 1.0);
            float depth = texelFetch(depthMap, q, 0).r;
            if ((x == 0 && y == 0) || q != clamp(q, ivec2(0), last) || depth >= 1.0) continue;
            vec3 other = texelFetch(normalMap, q, 0).xyz * 2.0 - 1.0;
            if (dot(other, towards) <= faces) continue;
            w *= surfaceWeight(planeDistance(plane, q, depth), dot(n, other));
            sum += w * vec2(seenAt(sun, q).x, 1.0);
        }
    return sum.x / sum.y;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    visibility0 = vec4(1.0);
    visibility1 = vec4(1.0);
    for (int i = 0; i < sunCount; ++i) {
        float v = visibilityOf(i, p);
        if (i < 4)
            visibility0[i] = v;
        else
            visibility1[i - 4] = v;
    }
}
