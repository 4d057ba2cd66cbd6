// SPDX-License-Identifier: MIT
// What lobes reflect of a disc of even radiance at infinity, as a sun that was cut from the map. Local frame as in lib/ggx.glsl; unit
// radiance.
#ifndef GLINT_GLSL
#define GLINT_GLSL

#include "lib/bsdf.glsl"
#include "lib/constants.glsl"
#include "lib/errorfunction.glsl"
#include "lib/sun.glsl"

// Nodes across a disc; fewer where it is small beside the lobe, which varies little over it.
const int DISC_NODES = 8;
const int SMALL_DISC_NODES = 3;

// Node i of 8 of Gauss and Legendre on [-1, 1], and its weight.
vec2 discNode(int i)
{
    int k = i < 4 ? 3 - i : i - 4;
    vec2 n = k == 0 ? vec2(0.1834346424956498, 0.3626837833783620)
           : k == 1 ? vec2(0.5255324099163290, 0.3137066458778873)
           : k == 2 ? vec2(0.7966664774136267, 0.2223810344533745)
                    : vec2(0.9602898564975363, 0.1012285362903763);
    return i < 4 ? vec2(-n.x, n.y) : n;
}

// Node i of 3 of the Gauss-Chebyshev rule of the second kind, and its weight over sqrt(1 - x^2): the chords of a disc have that factor.
vec2 smallDiscNode(int i)
{
    return i == 1 ? vec2(0.0, 0.25 * PI) : vec2(0.7071067811865476 * float(i - 1), 0.5553603672697958);
}

// Two tangents of the unit vector s.
vec3 discTangent(vec3 s)
{
    return normalize(abs(s.x) < 0.6 ? vec3(0.0, s.z, -s.y) : vec3(-s.z, 0.0, s.x));
}

// The normals half-way between v and the points of a disc about s, local, in the plane of slopes: an ellipse (specular.md 3). Slopes
// are in units of the lobe's alphas.
// Nothing is a difference of what is large: slopes are in the thousands where sun and view graze the surface, and a sun's
// radiance shows each lost digit as a firefly.
struct SlopeDisc {
    vec2 middle;        // across the ellipse's long axis and along it
    float halfWidth;
    float halfLength;
    vec3 direction;     // to the disc, lifted from the horizon
    float area;         // what a distribution's share of the ellipse, times the visibility, counts for in the integral of D V cos
};

SlopeDisc slopeDisc(vec3 s, vec3 v, float radius, vec2 alpha)
{
    SlopeDisc d;
    float share = discShare(s.z, radius);
    s.z = max(s.z, 1e-3); // below, the share that is left is seen at the horizon
    s = normalize(s);
    vec3 h = s + v;
    vec2 m = vec2(h) / h.z;
    vec3 e1 = discTangent(s);
    vec3 e2 = cross(s, e1);
    float scale = tan(radius) / h.z;
    vec2 g1 = (vec2(e1) - m * e1.z) * scale / alpha;
    vec2 g2 = (vec2(e2) - m * e2.z) * scale / alpha;
    m /= alpha;
    float a = g1.x * g1.x + g2.x * g2.x;
    float b = g1.x * g1.y + g2.x * g2.y;
    float c = g1.y * g1.y + g2.y * g2.y;
    d.halfLength = sqrt(0.5 * (a + c) + sqrt(0.25 * (a - c) * (a - c) + b * b));
    d.halfWidth = max(scale * scale * dot(s, h) / (h.z * alpha.x * alpha.y * d.halfLength), 1e-4 * d.halfLength);
    vec2 along = a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    if (abs(b) > 1e-6 * d.halfLength * d.halfLength)
        along = normalize(a >= c ? vec2(d.halfLength * d.halfLength - c, b) : vec2(b, d.halfLength * d.halfLength - a));
    d.middle = vec2(m.y * along.x - m.x * along.y, dot(m, along));
    d.direction = s;
    d.area = share * 4.0 * s.z * dot(h, v) / h.z;
    return d;
}

// Whether sun and view are both so low that slopes vary too much over the disc for an ellipse.
bool discIsGrazed(vec3 s, vec3 v, float radius)
{
    return max(s.z, 0.0) + v.z < 2.0 * tan(radius);
}

// Integral from y0 to y1 of 2 / (1 + y^2)^2, by its middle and its width; where it is narrow by a series, for the closed form
// loses as many digits as there are in the square of the middle.
float lobeAlong(float middle, float width)
{
    float q = 1.0 + middle * middle;
    if (width * width < 0.01 * q) return 2.0 * width / (q * q) * (1.0 + width * width * (20.0 * q - 24.0) / (24.0 * q * q));
    float y0 = middle - 0.5 * width;
    float y1 = middle + 0.5 * width;
    return width * (1.0 - y0 * y1) / ((1.0 + y0 * y0) * (1.0 + y1 * y1)) + atan(width, 1.0 + y0 * y1);
}

// Share of GGX's normals, by their density in the plane of slopes, that lies in the ellipse: a closed form along it, a quadrature across it.
float ggxShareOfDisc(SlopeDisc d)
{
    float t0 = atan(d.middle.x - d.halfWidth);
    float t1 = atan(d.middle.x + d.halfWidth);
    bool narrow = t1 - t0 < 0.1; // nodes even in u, else in t, where the lobe is narrower than the disc
    bool small = narrow && d.halfLength * d.halfLength < 0.04 * (1.0 + dot(d.middle, d.middle));
    int count = small ? SMALL_DISC_NODES : DISC_NODES;
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 node = small ? smallDiscNode(i) : discNode(i);
        float t = 0.5 * (t0 + t1) + 0.5 * (t1 - t0) * node.x;
        float u = narrow ? node.x : (tan(t) - d.middle.x) / d.halfWidth;
        float x = d.middle.x + d.halfWidth * u;
        float cosT = narrow ? 1.0 / sqrt(1.0 + x * x) : cos(t);
        float dt = narrow ? d.halfWidth * cosT * cosT : 0.5 * (t1 - t0);
        float chord = d.halfLength * sqrt(max(1.0 - u * u, 0.0));
        sum += node.y * dt * cosT * lobeAlong(d.middle.y * cosT, 2.0 * chord * cosT);
    }
    return 0.5 * INV_PI * sum;
}

// Integral of exp(-y^2) over [middle - width/2, middle + width/2]. Where it is narrow by 3 nodes of Gauss and Legendre: the
// difference of two error functions loses its digits far from the peak.
float gaussianAlong(float middle, float width)
{
    if (width < 1.0) {
        float y = 0.38729833462 * width;  // sqrt(3/5) / 2
        return width / 18.0 * (8.0 * exp(-middle * middle) + 5.0 * exp(-(middle - y) * (middle - y)) +
                               5.0 * exp(-(middle + y) * (middle + y)));
    }
    float low = middle - 0.5 * width;
    float high = middle + 0.5 * width;
    return 0.88622692545 * (sign(high) * errorFunction(abs(high)) - sign(low) * errorFunction(abs(low)));
}

// The same share of Beckmann's normals, which are a Gaussian there. Nodes only where the lobe is.
float beckmannShareOfDisc(SlopeDisc d)
{
    float low = max(-1.0, (-4.0 - d.middle.x) / d.halfWidth);
    float high = min(1.0, (4.0 - d.middle.x) / d.halfWidth);
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        vec2 node = discNode(i);
        float u = 0.5 * (low + high) + 0.5 * max(high - low, 0.0) * node.x;
        float x = d.middle.x + d.halfWidth * u;
        float chord = d.halfLength * sqrt(max(1.0 - u * u, 0.0));
        sum += node.y * exp(-x * x) * gaussianAlong(d.middle.y, 2.0 * chord);
    }
    return 0.5 * max(high - low, 0.0) * d.halfWidth * INV_PI * sum;
}

// Density of the Blinn-Phong normals over Beckmann's of the same alpha, at the point of the ellipse that is nearest to the peak.
float blinnOverBeckmann(SlopeDisc d, float alpha)
{
    float slope = max(length(d.middle) - d.halfLength, 0.0);
    float m2 = slope * slope;
    return exp(clamp(m2 - (1.0 / (alpha * alpha) + 1.0) * log(1.0 + m2 * alpha * alpha), -80.0, 80.0));
}

#ifdef HAS_MICROFACETS
// Integral of D V cos over a disc that grazes: too little of the lobe is in it to need an ellipse. 8 points of a spiral, those above
// the horizon.
float grazedDisc(Bsdf b, vec3 s, vec3 v, float radius)
{
    vec3 e1 = discTangent(s);
    vec3 e2 = cross(s, e1);
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        float r = tan(radius) * sqrt((float(i) + 0.5) / 8.0);
        float angle = 2.39996322972865332 * float(i);
        vec3 l = normalize(s + e1 * (r * cos(angle)) + e2 * (r * sin(angle)));
        if (l.z > 0.0) sum += bsdfMicrofacets(b, v, l, normalize(v + l)) * l.z;
    }
    return min(sum * PI * sin(radius) * sin(radius) / 8.0, 1.0);
}

// Integral of D V cos over the disc about s, seen from v, both local. No Fresnel factor. As alpha goes to 0, the disc's mirror image.
float microfacetDisc(Bsdf b, vec3 s, vec3 v, float radius)
{
    if (discShare(s.z, radius) <= 0.0) return 0.0;
    if (discIsGrazed(s, v, radius)) return grazedDisc(b, s, v, radius);
    SlopeDisc d = slopeDisc(s, v, radius, vec2(lobeAlpha(b)));
    float share = 0.0;
#ifdef HAS_GGX
    if (b.brdf == BRDF_COOK_TORRANCE) share = ggxShareOfDisc(d);
#endif
#ifdef HAS_BECKMANN
    if (b.brdf == BRDF_BECKMANN) share = beckmannShareOfDisc(d);
#endif
#ifdef HAS_BLINN_PHONG
    if (b.brdf == BRDF_BLINN_PHONG) share = beckmannShareOfDisc(d) * blinnOverBeckmann(d, b.roughness * b.roughness);
#endif
    return d.area * share * bsdfVisibility(b, v, d.direction);
}
#endif

// log(cos(x)), by series where it would round; for x up to a right angle.
float logCosine(float x)
{
    float x2 = x * x;
    return x2 < 0.04 ? -x2 * (0.5 + x2 * (1.0 / 12.0 + x2 / 45.0)) : log(max(cos(x), 1e-6));
}

// Angle between unit vectors: by the series of 2 asin(c/2) in the chord c where the functions built in are good to 1e-6 only,
// which the exponents of sharp lobes multiply.
float angleBetween(vec3 a, vec3 b)
{
    vec3 d = a - b;
    float c2 = dot(d, d);
    if (c2 > 0.25) return atan(length(cross(a, b)), dot(a, b));
    return sqrt(c2) * (1.0 + c2 * (1.0 / 24.0 + c2 * (3.0 / 640.0 + c2 * 5.0 / 7168.0)));
}

// Integral of cos^exponent of the angle to r over the disc about s: nodes across the disc where the lobe reaches it, along it
// a Gaussian of the lobe's width.
float phongDisc(vec3 r, vec3 s, float exponent, float radius)
{
    float distance = angleBetween(r, s);
    float width = 1.0 / sqrt(max(exponent, 1e-6));
    float reach = 4.0 * width;
    float nearest = max(distance - radius, 0.0);
    // From the disc's centre: small discs keep their digits.
    float low = max(-radius, -reach - distance);
    float high = min(min(radius, max(reach - distance, low + reach)), 0.5 * PI - distance);
    if (high <= low) return 0.0;
    bool small = radius < 0.2 * width && high - low >= 2.0 * radius;
    int count = small ? SMALL_DISC_NODES : DISC_NODES;
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 node = small ? smallDiscNode(i) : discNode(i);
        float w = 0.5 * (low + high) + 0.5 * (high - low) * node.x;
        float chord = sqrt(max((radius - w) * (radius + w), 0.0));
        // Relative to the lobe at the disc's nearest point, which keeps far discs from underflow.
        sum += node.y * exp(exponent * (logCosine(distance + w) - logCosine(nearest))) * errorFunction(chord / (width * sqrt(2.0)));
    }
    return sum * 0.5 * (high - low) * sqrt(TWO_PI) * width * exp(exponent * logCosine(nearest));
}

// What the lobe sends to v of the disc about s.
vec3 bsdfDisc(Bsdf b, vec3 s, vec3 v, float radius)
{
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (isMirrored(b.brdf)) {
        float n = phongExponent(b.roughness);
        float cosine = discIrradianceOverPi(s.z, radius) / (sin(radius) * sin(radius));
        return bsdfMirrored(b, v.z, max(s.z, 0.0)) * (n + 2.0) / TWO_PI * phongDisc(vec3(-v.x, -v.y, v.z), s, n, radius) * cosine;
    }
#endif
#ifdef HAS_MICROFACETS
    if (isMicrofacets(b.brdf)) return b.energy * bsdfFresnel(b, dot(normalize(v + s), v)) * microfacetDisc(b, s, v, radius);
#endif
    return vec3(0.0);
}

#endif
