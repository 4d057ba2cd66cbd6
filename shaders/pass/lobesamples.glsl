// SPDX-License-Identifier: MIT
// What a lobe reflects of the map, the integral of L f_H cos [seed 000, eq. 3, first term], and of the suns. Filtered importance
// sampling [Colbert, Krivanek 2008] draws directions from the BRDF. It looks each up in the level of the pyramid whose texels are as
// wide as the sample's share of the lobe. With PREFILTERED, one look-up instead. Radiance in units of the map's mean.
#ifndef LOBESAMPLES_GLSL
#define LOBESAMPLES_GLSL
#pragma import_defines(HAS_SUNS, PREFILTERED)

#include "lib/frame.glsl"
#include "lib/limits.glsl"
#include "lib/prefiltered.glsl"
#include "lib/sequence.glsl"
#include "pass/albedo.glsl"
#include "pass/maplight.glsl"
#ifdef HAS_SUNS
#include "lib/glint.glsl"
#include "pass/suns.glsl"
#endif

#ifdef PREFILTERED
uniform sampler2D prefilteredMap;
#endif
uniform int specularSamples;
uniform vec2 sampleShift;    // of the points, in a still view
uniform float sampleFrames;  // that will be averaged: each sample is as narrow as a share of theirs

struct LobePixel {
    Bsdf bsdf;
    float alpha;      // of the lobe, or of an even one as wide
    vec3 view;        // local
    mat3 mapFromLocal;
    float group;      // number in its cell, less apart where fewer pixels share their lobes
    float companions; // pixels that the filter averages with this one
    int samples;
};

// A lobe that is drawn out takes more samples, or they would lie farther apart along it than it is wide.
const float MOST_SAMPLES = 4.0;  // times those of an even lobe

int samplesOf(Bsdf b)
{
#ifdef HAS_ANISOTROPY
    if (b.anisotropy > 0.0) {
        vec2 alpha = lobeAlpha(b);
        return int(float(specularSamples) * clamp(sqrt(alpha.x / alpha.y), 1.0, MOST_SAMPLES));
    }
#endif
    return specularSamples;
}

#ifdef PREFILTERED
// GGX's lobes have long tails. One of another distribution is best looked up as one of GGX with this share of its alpha. A lobe about the
// mirror direction is as wide as the lobe of normals with half of its alpha.
const float TAILLESS = 0.6;

// As of samples: radiance and weight.
vec4 sampled(LobePixel l)
{
    Bsdf b = l.bsdf;
    float alpha = l.alpha * (b.brdf == BRDF_COOK_TORRANCE ? 1.0 : TAILLESS) * (isMirrored(b.brdf) ? 0.5 : 1.0);
    float level = prefilteredLevel(pyramidSide, alpha);
    vec3 d = l.mapFromLocal * dominantDirection(l.view, alpha);
    vec3 seen = pyramidLookup(prefilteredMap, pyramidSide, pyramidLastLevel, d, level);
    if (level < 0.0) seen = mix(mirror(d), seen, exp2(level));
    return vec4(b.reflected * seen, 1.0);
}
#else
vec2 unitVector(float angle)
{
    return vec2(cos(angle), sin(angle));
}

// The azimuth of the next sample from that of the one before, both as unit vectors: they follow each other by equal angles.
vec2 nextAzimuth(vec2 azimuth, vec2 turn)
{
    return vec2(azimuth.x * turn.x - azimuth.y * turn.y, azimuth.x * turn.y + azimuth.y * turn.x);
}

vec2 firstAzimuth(LobePixel l)
{
    return unitVector(TWO_PI * (cellPoint(0, l.group, l.samples).x + 0.5 / float(l.samples) + sampleShift.x));
}

// Where sample i lies between the lobe's middle and its end. The tails get more samples than their share of the lobe, each with less
// weight: a lamp there may outshine what the middle shows.
struct Tail {
    float left;   // share of the lobe that lies farther out, above 0
    float count;  // for how many samples of the lobe it counts, 1 in the mean
};

// even: share of the samples that are spread as the lobe is.
Tail sampleTail(LobePixel l, int i, float even)
{
    float left = max(1.0 - fract(cellPoint(i, l.group, l.samples).y + sampleShift.y), 1e-15);
    return Tail(left * mix(left, 1.0, even), mix(2.0 * left, 1.0, even));
}

// That will be averaged.
float samplesInAll(LobePixel l)
{
    return float(l.samples) * sampleFrames * l.companions;
}

#ifdef HAS_MICROFACETS
// Normals are drawn from those of GGX that are visible; other distributions of the same alpha weigh them (specular.md 6).
vec4 microfacets(LobePixel l)
{
    vec3 v = l.view;
    LOBE_ALPHA alpha = lobeAlpha(l.bsdf);
    GgxCap cap = ggxCap(v, alpha);
    float rootV = ggxRoot(v, alpha);
    float pdfFactor = ggxPdfFactor(v.z, rootV, alpha);
    float lodOfUnitSpread = lodOfUnitDensity(samplesInAll(l)) - 0.5 * log2(pdfFactor);
    vec2 azimuth = firstAzimuth(l);
    vec2 turn = unitVector(TWO_PI / float(l.samples));
    vec3 num = vec3(0.0);
    vec3 den = vec3(0.0);
    for (int i = 0; i < l.samples; ++i) {
        Tail tail = sampleTail(l, i, l.alpha);
        vec3 h = ggxCapNormal(cap, azimuth, 1.0 - tail.left);
        azimuth = nextAzimuth(azimuth, turn);
        float c = dot(v, h);
        vec3 d = 2.0 * c * h - v;
        float spread = ggxSpread(h, alpha);
        float w = d.z > 0.0 ? tail.count * ggxUnshadowed(v.z, rootV, d.z, ggxRoot(d, alpha)) : 0.0;
#if defined(HAS_BECKMANN) || defined(HAS_BLINN_PHONG)
        if (l.bsdf.brdf != BRDF_COOK_TORRANCE)
            w = tail.count * bsdfMicrofacets(l.bsdf, v, d, h) * max(d.z, 0.0) * spread * spread / pdfFactor;
#endif
        vec3 weight = w * bsdfFresnel(l.bsdf, c);
        num += weight * filtered(l.mapFromLocal * d, lodOfUnitSpread + log2(spread) + 0.5 * log2(tail.count));
        den += weight;
    }
    // Of sums that are divided by the weights' share of their mean, the albedo, an even map has no noise.
    float weight = dot(den * l.bsdf.energy, vec3(1.0)) / max(dot(l.bsdf.reflected, vec3(1.0)), 1e-4);
    return vec4(num * l.bsdf.energy, weight) / float(l.samples);
}
#endif

#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
vec4 mirrorLobe(LobePixel l)
{
    float n = phongExponent(l.bsdf.roughness);
    mat3 lobe = frameAround(vec3(-l.view.x, -l.view.y, l.view.z));
    vec2 azimuth = firstAzimuth(l);
    vec2 turn = unitVector(TWO_PI / float(l.samples));
    float unitLod = lodOfUnitDensity(samplesInAll(l));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < l.samples; ++i) {
        Tail tail = sampleTail(l, i, 0.0);
        float logU = log(tail.left);
        vec3 d = lobe * phongDirection(n, azimuth, logU);
        azimuth = nextAzimuth(azimuth, turn);
        float lod = unitLod + 0.5 * (log(tail.count) - phongLogPdf(n, logU)) / log(2.0);
        sum += bsdfMirrored(l.bsdf, l.view.z, d.z) * (tail.count * max(d.z, 0.0)) * filtered(l.mapFromLocal * d, lod);
    }
    return vec4((n + 2.0) / (n + 1.0) * sum / float(l.samples), 1.0);
}
#endif

// Of radiance and weight, by samples of the lobe; their weight is 1 in the mean.
vec4 sampled(LobePixel l)
{
    bool isMirror = l.alpha < MIRROR_ALPHA;
    vec3 seen = isMirror ? mirror(l.mapFromLocal * vec3(-l.view.x, -l.view.y, l.view.z)) : vec3(0.0);
#ifdef HAS_MICROFACETS
    if (isMicrofacets(l.bsdf.brdf)) return isMirror ? vec4(l.bsdf.energy * bsdfFresnel(l.bsdf, l.view.z) * seen, 1.0) : microfacets(l);
#endif
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (isMirrored(l.bsdf.brdf)) return isMirror ? vec4(l.bsdf.reflected * seen, 1.0) : mirrorLobe(l);
#endif
    return vec4(0.0);
}
#endif

#ifdef HAS_SUNS
vec3 glint(LobePixel l)
{
    vec3 sum = vec3(0.0);
    if (l.alpha < MIRROR_ALPHA) return sum;
    for (int i = 0; i < sunCount; ++i)
        sum += sunVisibility(i) * sunRadiance[i] * bsdfDisc(l.bsdf, sunDirection[i] * l.mapFromLocal, l.view, sunRadius[i]);
    return sum;
}
#endif

#endif
