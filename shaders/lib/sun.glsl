// SPDX-License-Identifier: MIT
// A disc of even radiance at infinity, as a sun or lamp that was cut from the map: what it sends a surface, and what the
// lobes reflect of it. In the surface's local frame where a function says so (normal +Z); unit radiance.
#ifndef SUN_GLSL
#define SUN_GLSL

#include "lib/constants.glsl"
#include "lib/ggx.glsl"
#include "lib/phong.glsl"

// Irradiance over pi from a disc of angular radius s about a direction of that cosine to the normal; exact across the
// horizon [the sphere of systems.md A2].
float discIrradianceOverPi(float cosine, float s)
{
    float sinS = sin(s);
    float sinW = sqrt(max(1.0 - cosine * cosine, 0.0));
    if (cosine >= sinS) return sinS * sinS * cosine;
    if (cosine <= -sinS) return 0.0;
    float t = sinS / cos(s);
    float y = clamp(-cosine / (t * max(sinW, 1e-6)), -1.0, 1.0);
    float q = sinW * sqrt(max(1.0 - y * y, 0.0));
    // atan(q t) - q sin s cos s, whose terms of the first order cancel
    float z = q * t;
    float z2 = z * z;
    float rest = z2 < 0.01 ? z * (t * t / (1.0 + t * t) - z2 * (1.0 / 3.0 - z2 * (1.0 / 5.0 - z2 / 7.0)))
                           : atan(z) - q * sinS * cos(s);
    return max((sinS * sinS * cosine * acos(y) + rest) * INV_PI, 0.0);
}

// Share of the disc above the horizon, by its diameter.
float discShare(float cosine, float s)
{
    return clamp(0.5 + 0.5 * cosine / sin(s), 0.0, 1.0);
}

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

// Two tangents of the unit vector s.
vec3 discTangent(vec3 s)
{
    return normalize(abs(s.x) < 0.6 ? vec3(0.0, s.z, -s.y) : vec3(-s.z, 0.0, s.x));
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

// The same as ggxDisc where sun and view are both within a disc or two of the horizon: slopes vary too much over the disc to be
// an ellipse, and too little of the lobe is in it to need one. 8 points of a spiral, those above the horizon.
float ggxGrazedDisc(vec3 s, vec3 v, float alpha, float radius)
{
    vec3 e1 = discTangent(s);
    vec3 e2 = cross(s, e1);
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        float r = tan(radius) * sqrt((float(i) + 0.5) / 8.0);
        float angle = 2.39996322972865332 * float(i);
        vec3 l = normalize(s + e1 * (r * cos(angle)) + e2 * (r * sin(angle)));
        if (l.z > 0.0) sum += ggxBrdf(v, l, alpha) * l.z;
    }
    return min(sum * PI * sin(radius) * sin(radius) / 8.0, 1.0);
}

// Integral of D V cos over the disc about s, seen from v, both local. The disc is an ellipse in the plane of slopes: 8
// nodes across it, closed along it (specular.md 3). No Fresnel factor. As alpha goes to 0, the disc's mirror image.
// Nothing is a difference of what is large: slopes are in the thousands where sun and view graze the surface, and a sun's
// radiance shows each lost digit as a firefly.
float ggxDisc(vec3 s, vec3 v, float alpha, float radius)
{
    float share = discShare(s.z, radius);
    if (share <= 0.0) return 0.0;
    if (max(s.z, 0.0) + v.z < 2.0 * tan(radius)) return ggxGrazedDisc(s, v, alpha, radius);
    s.z = max(s.z, 1e-3); // below, the share that is left is seen at the horizon
    s = normalize(s);
    vec3 h = s + v;
    vec2 m = vec2(h) / h.z;
    vec3 e1 = discTangent(s);
    vec3 e2 = cross(s, e1);
    float scale = tan(radius) / h.z;
    vec2 g1 = (vec2(e1) - m * e1.z) * scale;
    vec2 g2 = (vec2(e2) - m * e2.z) * scale;
    float a = g1.x * g1.x + g2.x * g2.x;
    float b = g1.x * g1.y + g2.x * g2.y;
    float c = g1.y * g1.y + g2.y * g2.y;
    float a1 = sqrt(0.5 * (a + c) + sqrt(0.25 * (a - c) * (a - c) + b * b));
    float a2 = max(scale * scale * dot(s, h) / (h.z * a1), 1e-4 * a1);
    vec2 along = a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    if (abs(b) > 1e-6 * a1 * a1) along = normalize(a >= c ? vec2(a1 * a1 - c, b) : vec2(b, a1 * a1 - a));
    float py = dot(m, along);
    float px = m.y * along.x - m.x * along.y;
    float t0 = atan((px - a2) / alpha);
    float t1 = atan((px + a2) / alpha);
    bool narrow = t1 - t0 < 0.1; // nodes even in u, else in t, where the lobe is narrower than the disc
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        vec2 node = discNode(i);
        float t = 0.5 * (t0 + t1) + 0.5 * (t1 - t0) * node.x;
        float u = narrow ? node.x : (alpha * tan(t) - px) / a2;
        float x = (px + a2 * u) / alpha;
        float cosT = narrow ? 1.0 / sqrt(1.0 + x * x) : cos(t);
        float dt = narrow ? a2 / alpha * cosT * cosT : 0.5 * (t1 - t0);
        float chord = a1 * sqrt(max(1.0 - u * u, 0.0));
        sum += node.y * dt * cosT * lobeAlong(py * cosT / alpha, 2.0 * chord * cosT / alpha);
    }
    sum *= 0.5 * INV_PI;
    return share * sum * 4.0 * s.z * ggxVisibility(v.z, s.z, alpha) * dot(h, v) / h.z;
}

// erf to 3e-7 for x >= 0 [Abramowitz, Stegun 7.1.28], and of itself near 0: no exponential.
float errorFunction(float x)
{
    float x2 = x * x;
    if (x2 < 0.04) return 1.1283791670955126 * x * (1.0 - x2 * (1.0 / 3.0 - x2 * (0.1 - x2 / 42.0)));
    float p = 1.0 + x * (0.0705230784 + x * (0.0422820123 + x * (0.0092705272 +
              x * (0.0001520143 + x * (0.0002765672 + x * 0.0000430638)))));
    p *= p;
    p *= p;
    p *= p;
    return 1.0 - 1.0 / (p * p);
}

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

// Integral of cos^exponent of the angle to r over the disc about s: 8 nodes across the disc where the lobe reaches it, along
// it a Gaussian of the lobe's width.
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
    float sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        vec2 node = discNode(i);
        float w = 0.5 * (low + high) + 0.5 * (high - low) * node.x;
        float chord = sqrt(max((radius - w) * (radius + w), 0.0));
        // Relative to the lobe at the disc's nearest point, which keeps far discs from underflow.
        sum += node.y * exp(exponent * (logCosine(distance + w) - logCosine(nearest))) * errorFunction(chord / (width * sqrt(2.0)));
    }
    return sum * 0.5 * (high - low) * sqrt(TWO_PI) * width * exp(exponent * logCosine(nearest));
}

#endif
