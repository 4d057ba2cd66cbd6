// SPDX-License-Identifier: MIT
// The modified Phong lobe, energy-normalised [Lafortune, Willems 1994]: f = ks (n+2)/(2 pi) cos^n about the mirror
// direction r, so that at normal incidence the lobe reflects exactly ks.
#ifndef PHONG_GLSL
#define PHONG_GLSL

#include "lib/constants.glsl"
#include "lib/errorfunction.glsl"

// log(1 - x), x in [0,1]: by series where 1 - x would round.
float logOneMinus(float x)
{
    return x < 0.01 ? -x * (1.0 + x * (0.5 + x * (0.33333333333 + x * 0.25))) : log(max(1.0 - x, 1e-30));
}

// cos^n of the angle between the unit vectors r and l. Written with 1 - cos = |r-l|^2/2, which keeps the digits that
// pow(dot(r, l), n) loses for n > 1e4.
float phongPower(vec3 r, vec3 l, float exponent)
{
    vec3 d = r - l;
    float x = 0.5 * dot(d, d);
    if (x >= 1.0) return 0.0;
    return exp(exponent * logOneMinus(x));
}

// BRDF value for ks = 1, per solid angle.
float phongBrdf(vec3 r, vec3 l, float exponent)
{
    return (exponent + 2.0) / TWO_PI * phongPower(r, l, exponent);
}

// Direction about (0,0,1), the mirror direction, by cosine and sine of its azimuth; the logarithm is of a number in (0,1].
vec3 phongDirection(float exponent, vec2 azimuth, float logU)
{
    float cosTheta = exp(logU / (exponent + 1.0));
    // 1 - cos^2 = -expm1(2 logU / (n+1)): by series where the cosine rounds to 1
    float x = 2.0 * logU / (exponent + 1.0);
    float sin2 = x > -0.01 ? -x * (1.0 + x * (0.5 + x * 0.16666666667)) : 1.0 - cosTheta * cosTheta;
    float sinTheta = sqrt(max(sin2, 0.0));
    return vec3(sinTheta * azimuth, cosTheta);
}

// The same for u in [0,1)^2.
vec3 phongSample(float exponent, vec2 u)
{
    float phi = TWO_PI * u.x;
    return phongDirection(exponent, vec2(cos(phi), sin(phi)), log(max(1.0 - u.y, 1e-30)));
}

// The logarithm of the density of phongDirection() per solid angle.
float phongLogPdf(float exponent, float logU)
{
    return log((exponent + 1.0) / TWO_PI) + exponent / (exponent + 1.0) * logU;
}

// Density of phongSample per solid angle, l about the mirror direction r.
float phongPdf(vec3 r, vec3 l, float exponent)
{
    return (exponent + 1.0) / TWO_PI * phongPower(r, l, exponent);
}

// Directional albedo of the lobe for ks = 1: the mean over the lobe of the cosine to the light, by which the BRDF is not divided. It falls
// towards grazing angles. The formula takes the cosine as normally distributed, and as 0 below the horizon. It errs by 5 %
// for n = 0, 3 % for n = 1, 2 % for n = 2, 1 % from n = 4 on, beside quadrature.
float phongAlbedo(float exponent, float cosV)
{
    float c = clamp(cosV, 0.0, 1.0);
    float mean = c * (exponent + 1.0) / (exponent + 2.0);
    float variance = max((1.0 - c * c) / (exponent + 2.5), 1e-12);
    float below = exp(-0.5 * mean * mean / variance) * sqrt(variance / TWO_PI);
    float cosine = 0.5 * mean * (1.0 + errorFunction(mean * inversesqrt(2.0 * variance))) + below;
    return cosine * (exponent + 2.0) / (exponent + 1.0);
}

// The G-buffer holds one number for the width of any lobe: roughness, alpha = roughness^2, and for Phong
// alpha = sqrt(2 / (n + 2)) [Walter 2007, by the width of the lobe].
float phongRoughness(float exponent)
{
    return sqrt(sqrt(2.0 / (exponent + 2.0)));
}

float phongExponent(float roughness)
{
    float r2 = roughness * roughness;
    return max(2.0 / (r2 * r2) - 2.0, 0.0);
}

#endif
