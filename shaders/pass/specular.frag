#version 330 compatibility
// SPDX-License-Identifier: MIT
// S: the glossy term, the integral of L f_H cos [seed 000, eq. 3, first term], by filtered importance sampling
// [Colbert, Krivanek 2008]: directions from the BRDF, each look-up as wide as the sample's share of the lobe.
// Radiance in units of the map's mean.
#pragma import_defines(HAS_SUNS, HAS_LOBES, LOBES_UNOCCLUDED)

#include "lib/frame.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/latlong.glsl"
#include "lib/octahedral.glsl"
#include "lib/phong.glsl"
#include "lib/sequence.glsl"
#include "pass/gbuffer.glsl"
#include "pass/albedo.glsl"
#ifdef HAS_SUNS
#include "pass/suns.glsl"
#endif

uniform sampler2D pyramidMap;
uniform sampler2D latlongMap;
uniform float pyramidSide;
uniform float pyramidLastLevel;
uniform int specularSamples;
uniform vec2 sampleShift;    // of the points, in a still view
uniform float sampleFrames;  // that will be averaged: each sample is as narrow as a share of theirs

layout(location = 0) out vec4 specular;
#ifdef HAS_LOBES
layout(location = 1) out vec4 blockedLobe; // the part of the lobe's albedo that surfaces take from the map
uniform sampler2D lobeSeenMap;
#endif

// Share of the map's light in the lobe that reaches the pixel.
float lobeSeen()
{
#ifdef HAS_LOBES
    return texelFetch(lobeSeenMap, ivec2(gl_FragCoord.xy), 0).r;
#else
    return 1.0;
#endif
}

// That of S: a still view's average takes what is blocked from it light by light.
float shownLobe()
{
#ifdef LOBES_UNOCCLUDED
    return 1.0;
#else
    return lobeSeen();
#endif
}

// Below this alpha one look-up at the map's own resolution is the lobe: a texel of a 1024-wide map is wider.
const float MIRROR_ALPHA = 0.0009;

vec3 mirror(vec3 d)
{
    return textureLod(latlongMap, latlongFromDirection(d), 0.0).rgb;
}

vec2 unitVector(float angle)
{
    return vec2(cos(angle), sin(angle));
}

// The azimuth of the next sample from that of the one before, both as unit vectors: they follow each other by equal angles.
vec2 nextAzimuth(vec2 azimuth, vec2 turn)
{
    return vec2(azimuth.x * turn.x - azimuth.y * turn.y, azimuth.x * turn.y + azimuth.y * turn.x);
}

vec2 firstAzimuth()
{
    return unitVector(TWO_PI * (0.5 / float(specularSamples) + sampleShift.x));
}

// The other number of sample i, in [0,1).
float sampleHeight(int i)
{
    return fract(hammersley(uint(i), uint(specularSamples)).y + sampleShift.y);
}

// The level of the pyramid whose texels are as wide as one of the samples at density 1; half the density's log2 finer is right.
float lodOfUnitDensity()
{
    return log2(pyramidSide) - 0.5 * log2(4.0 * PI * float(specularSamples) * sampleFrames);
}

vec3 filtered(vec3 d, float lod)
{
    return pyramidLookup(pyramidMap, pyramidSide, pyramidLastLevel, d, lod);
}

#ifdef HAS_COOK_TORRANCE
// Ratio estimator: sum(w F L) / sum(w) times the exact albedo, so that a constant map reflects exactly.
vec3 cookTorrance(vec3 v, mat3 mapFromLocal, vec3 f0, float roughness)
{
    float alpha = roughness * roughness;
    vec2 table = lobeAlbedo(roughness, v.z);
    float single = table.x + table.y;
    Bsdf b = makeBsdf(BRDF_COOK_TORRANCE, f0, roughness, table);
#ifdef HAS_LOBES
    blockedLobe = vec4((1.0 - lobeSeen()) * b.reflected, 0.0);
#endif
    if (alpha < MIRROR_ALPHA) return shownLobe() * fresnelSchlick(f0, v.z) * mirror(mapFromLocal * vec3(-v.x, -v.y, v.z));
    GgxCap cap = ggxCap(v, alpha);
    float rootV = ggxRoot(v.z, alpha);
    float lodOfUnitSpread = lodOfUnitDensity() - 0.5 * log2(ggxPdfFactor(v.z, rootV, alpha));
    vec2 azimuth = firstAzimuth();
    vec2 turn = unitVector(TWO_PI / float(specularSamples));
    vec3 num = vec3(0.0);
    float den = 0.0;
    for (int i = 0; i < specularSamples; ++i) {
        vec3 h = ggxCapNormal(cap, azimuth, sampleHeight(i));
        azimuth = nextAzimuth(azimuth, turn);
        float c = dot(v, h);
        vec3 l = 2.0 * c * h - v;
        float w = l.z > 0.0 ? ggxUnshadowed(v.z, rootV, l.z, ggxRoot(l.z, alpha)) : 0.0;
        num += w * fresnelSchlick(f0, c) * filtered(mapFromLocal * l, lodOfUnitSpread + log2(ggxSpread(h, alpha)));
        den += w;
    }
    vec3 sum = den > 0.0 ? num / den * (single * shownLobe()) : vec3(0.0);
#ifdef HAS_SUNS
    for (int i = 0; i < sunCount; ++i) {
        vec3 s = sunDirection[i] * mapFromLocal;
        sum += sunVisibility(i) * sunRadiance[i] * fresnelSchlick(f0, dot(normalize(v + s), v)) * ggxDisc(s, v, alpha, sunRadius[i]);
    }
#endif
    return sum * b.energy;
}
#endif

#ifdef HAS_PHONG
vec3 phong(vec3 v, mat3 mapFromLocal, vec3 ks, float roughness)
{
    vec3 r = vec3(-v.x, -v.y, v.z);
    float n = phongExponent(roughness);
    mat3 lobe = frameAround(r);
    float scale = (n + 2.0) / (n + 1.0);
#ifdef HAS_LOBES
    blockedLobe = vec4((1.0 - lobeSeen()) * ks, 0.0);
#endif
    if (roughness * roughness < MIRROR_ALPHA) return shownLobe() * ks * scale * v.z * mirror(mapFromLocal * r);
    vec2 azimuth = firstAzimuth();
    vec2 turn = unitVector(TWO_PI / float(specularSamples));
    float unitLod = lodOfUnitDensity();
    vec3 sum = vec3(0.0);
    for (int i = 0; i < specularSamples; ++i) {
        float logU = log(max(1.0 - sampleHeight(i), 1e-30));
        vec3 l = lobe * phongDirection(n, azimuth, logU);
        azimuth = nextAzimuth(azimuth, turn);
        float lod = unitLod - 0.5 * phongLogPdf(n, logU) / log(2.0);
        sum += max(l.z, 0.0) * filtered(mapFromLocal * l, lod);
    }
    sum *= shownLobe() * scale / float(specularSamples);
#ifdef HAS_SUNS
    for (int i = 0; i < sunCount; ++i) {
        vec3 s = sunDirection[i] * mapFromLocal;
        sum += sunVisibility(i) * sunRadiance[i] * (n + 2.0) / TWO_PI * phongDisc(r, s, n, sunRadius[i]) *
               (discIrradianceOverPi(s.z, sunRadius[i]) / (sin(sunRadius[i]) * sin(sunRadius[i])));
    }
#endif
    return ks * sum;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    specular = vec4(0.0);
#ifdef HAS_LOBES
    blockedLobe = vec4(0.0);
#endif
    vec4 f0 = texelFetch(specularMap, p, 0);
    int brdf = pixelBrdf(p);
    vec3 n = pixelNormal(p);
    float roughness = texelFetch(normalMap, p, 0).a;
    mat3 eyeFromLocal = frameAround(n);
    vec3 v = pixelView(p, eyeFromLocal);
    mat3 mapFromLocal = mapFromEye * eyeFromLocal;
#ifdef HAS_COOK_TORRANCE
    if (brdf == BRDF_COOK_TORRANCE) specular = vec4(cookTorrance(v, mapFromLocal, f0.rgb, roughness), 1.0);
#endif
#ifdef HAS_PHONG
    if (brdf == BRDF_PHONG) specular = vec4(phong(v, mapFromLocal, f0.rgb, roughness), 1.0);
#endif
}
