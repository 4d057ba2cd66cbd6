// SPDX-License-Identifier: MIT
// The GGX microfacet distribution with Smith's height-correlated masking [Walter 2007; Heitz 2014]. Local frame, normal
// (0,0,1); alpha = roughness squared, > 0; v towards the eye, l towards the light, h half-way, all of unit length. Brushed surfaces
// have two alphas, along the frame's x and along its y [Heitz 2014, eq. 85 and 86]; both the same, they are as one.
#ifndef GGX_GLSL
#define GGX_GLSL

#include "lib/constants.glsl"

// The sum in D's denominator. 1 - h.z^2 is written h.x^2 + h.y^2, which keeps its digits for small alpha.
float ggxSpread(vec3 h, float alpha)
{
    return h.x * h.x + h.y * h.y + alpha * alpha * h.z * h.z;
}

float ggxSpread(vec3 h, vec2 alpha)
{
    return h.x * h.x * (alpha.y / alpha.x) + h.y * h.y * (alpha.x / alpha.y) + alpha.x * alpha.y * h.z * h.z;
}

// Density of normals per solid angle; integral of D cos = 1.
float ggxD(vec3 h, float alpha)
{
    float d = ggxSpread(h, alpha);
    return alpha * alpha / (PI * d * d);
}

float ggxD(vec3 h, vec2 alpha)
{
    float d = ggxSpread(h, alpha);
    return alpha.x * alpha.y / (PI * d * d);
}

// sqrt(cos^2 + alpha^2 sin^2): the root that G1, G2 and the pdf share.
float ggxRoot(float cosTheta, float alpha)
{
    return sqrt(cosTheta * cosTheta * (1.0 - alpha * alpha) + alpha * alpha);
}

float ggxRoot(vec3 v, float alpha)
{
    return ggxRoot(v.z, alpha);
}

float ggxRoot(vec3 v, vec2 alpha)
{
    vec3 w = vec3(alpha * vec2(v.x, v.y), v.z);
    return sqrt(dot(w, w));
}

// Share of the visible normals' reflections that is not shadowed on the way out, G2/G1(v) [Heitz 2014, eq. 99], by the roots
// of both.
float ggxUnshadowed(float cosV, float rootV, float cosL, float rootL)
{
    return cosL * (cosV + rootV) / (cosL * rootV + cosV * rootL);
}

float ggxG2OverG1(float cosV, float cosL, float alpha)
{
    return ggxUnshadowed(cosV, ggxRoot(cosV, alpha), cosL, ggxRoot(cosL, alpha));
}

// Visibility G2 / (4 cosV cosL) of any distribution, never dividing by the cosines; a root is cos (1 + 2 Lambda).
float smithVisibility(float cosV, float rootV, float cosL, float rootL)
{
    return 0.5 / max(cosL * rootV + cosV * rootL, 1e-30);
}

float ggxVisibility(float cosV, float cosL, float alpha)
{
    return smithVisibility(cosV, ggxRoot(cosV, alpha), cosL, ggxRoot(cosL, alpha));
}

// BRDF value without Fresnel, per solid angle.
float ggxBrdf(vec3 v, vec3 l, float alpha)
{
    if (v.z <= 0.0 || l.z <= 0.0) return 0.0;
    return ggxD(normalize(v + l), alpha) * ggxVisibility(v.z, l.z, alpha);
}

float ggxBrdf(vec3 v, vec3 l, vec2 alpha)
{
    if (v.z <= 0.0 || l.z <= 0.0) return 0.0;
    return ggxD(normalize(v + l), alpha) * smithVisibility(v.z, ggxRoot(v, alpha), l.z, ggxRoot(l, alpha));
}

// What the normals visible from a direction share: the spherical cap that they are stretched from [Dupuy, Benyoub 2023].
struct GgxCap {
    vec2 alpha;
    vec3 axis;
    float rest;  // 1 - axis.z
};

GgxCap ggxCap(vec3 v, vec2 alpha)
{
    GgxCap cap;
    cap.alpha = alpha;
    cap.axis = normalize(vec3(alpha * vec2(v.x, v.y), v.z));
    cap.rest = (cap.axis.x * cap.axis.x + cap.axis.y * cap.axis.y) / (1.0 + cap.axis.z);
    return cap;
}

GgxCap ggxCap(vec3 v, float alpha)
{
    return ggxCap(v, vec2(alpha));
}

// A visible normal by cosine and sine of its azimuth in the cap, and its height there, u in [0,1).
vec3 ggxCapNormal(GgxCap cap, vec2 azimuth, float u)
{
    vec3 w = cap.axis;
    // The cap's point has height c = z - w.z: 1 - c and 1 + c are written without differences, which would lose the
    // float's digits for u near 0 and 1.
    float z = (1.0 - u) * (1.0 + w.z);
    float s = sqrt(u * (1.0 + w.z) * (z + cap.rest));
    return normalize(vec3(cap.alpha * (s * azimuth + vec2(w.x, w.y)), max(z, 1e-7)));
}

// A normal visible from v, for u in [0,1)^2.
vec3 ggxVisibleNormalSample(vec3 v, vec2 alpha, vec2 u)
{
    float phi = TWO_PI * u.x;
    return ggxCapNormal(ggxCap(v, alpha), vec2(cos(phi), sin(phi)), u.y);
}

vec3 ggxVisibleNormalSample(vec3 v, float alpha, vec2 u)
{
    return ggxVisibleNormalSample(v, vec2(alpha), u);
}

// What the densities of all reflections of v share: ggxReflectionPdf() is this over the square of ggxSpread().
float ggxPdfFactor(float cosV, float rootV, float alpha)
{
    return 0.5 * alpha * alpha / (PI * (cosV + rootV));
}

float ggxPdfFactor(float cosV, float rootV, vec2 alpha)
{
    return 0.5 * alpha.x * alpha.y / (PI * (cosV + rootV));
}

// Density per solid angle of the direction l that reflects v at a sampled visible normal h: D G1 / (4 v.z).
float ggxReflectionPdf(vec3 v, vec3 h, float alpha)
{
    float d = ggxSpread(h, alpha);
    return ggxPdfFactor(v.z, ggxRoot(v.z, alpha), alpha) / (d * d);
}

float ggxReflectionPdf(vec3 v, vec3 h, vec2 alpha)
{
    float d = ggxSpread(h, alpha);
    return ggxPdfFactor(v.z, ggxRoot(v, alpha), alpha) / (d * d);
}

// By which the lights of maps weigh in a lobe: the distribution of normals half-way, over its peak.
float lobeShare(vec3 v, vec3 l, float alpha)
{
    float t = ggxSpread(normalize(v + l), alpha) / (alpha * alpha);
    return 1.0 / (t * t);
}

float lobeShare(vec3 v, vec3 l, vec2 alpha)
{
    float t = ggxSpread(normalize(v + l), alpha) / (alpha.x * alpha.y);
    return 1.0 / (t * t);
}

#endif
