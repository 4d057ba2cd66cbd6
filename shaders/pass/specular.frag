#version 330 compatibility
// SPDX-License-Identifier: MIT
// S, first part. Each pixel of a 4x4 cell takes samples of its own, and leaves two sums, which the filter averages over the cell
// [specular.md 2].
#pragma import_defines(HAS_SUNS)

#include "lib/bilateral.glsl"
#include "pass/lobesamples.glsl"
#include "pass/lobewidth.glsl"
#include "pass/pixelbsdf.glsl"

layout(location = 0) out vec4 estimate;  // radiance times weight, weight
#ifdef HAS_SUNS
layout(location = 1) out vec4 sunGlint;
#endif

// How many of a row's or column's four pixels share this one's lobe, by how much it turns from one to the next.
float companionsAlong(ivec2 p, ivec2 direction, float viewTurn, float narrowness)
{
    ivec2 last = ivec2(viewportSize) - 1;
    vec3 d = pixelNormal(min(p + direction, last)) - pixelNormal(max(p - direction, ivec2(0)));
    float turn = lobeTurn(0.5 * d, viewTurn);  // per pixel
    return min(1.0 + 1.77 / max(turn * sqrt(narrowness), 1e-3), 4.0);
}

LobePixel lobePixel(ivec2 p)
{
    vec3 n = pixelNormal(p);
    float roughness = texelFetch(normalMap, p, 0).a;
    mat3 eyeFromLocal = pixelFrame(p, n);
    LobePixel l;
    l.view = pixelView(p, eyeFromLocal);
    l.mapFromLocal = mapFromEye * eyeFromLocal;
    l.bsdf = pixelBsdf(p, l.view);
    l.alpha = evenAlpha(l.bsdf);
    l.samples = samplesOf(l.bsdf);
    float narrowness = lobeNarrowness(roughness, SHARED_TURN);
    float viewTurn = pixelTurn(pixelNdc(p));
    l.companions = sampleFrames > 1.0 ? 1.0 : companionsAlong(p, ivec2(1, 0), viewTurn, narrowness) *
                                              companionsAlong(p, ivec2(0, 1), viewTurn, narrowness);
    l.group = float(bayer4(p.x, p.y)) * min((l.companions - 1.0) / 8.0, 1.0);
    return l;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    LobePixel l = lobePixel(p);
    estimate = sampled(l);
    // Neighbours of other colours share what lies behind them, not their colour.
    estimate.rgb /= max(l.bsdf.reflected, vec3(1e-4));
#ifdef HAS_SUNS
    sunGlint = vec4(glint(l), 1.0);
#endif
}
