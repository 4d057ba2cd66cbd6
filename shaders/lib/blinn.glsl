// SPDX-License-Identifier: MIT
// Blinn's cos^n of the angle between normal and half vector, as OpenGL's fixed function has it, as a distribution of microfacets
// [Walter 2007, eq. 30], with Smith's masking of that distribution. Its width is that of Beckmann's of alpha = sqrt(2 / (n + 2)).
// Local frame as in lib/ggx.glsl.
#ifndef BLINN_GLSL
#define BLINN_GLSL

#include "lib/constants.glsl"
#include "lib/errorfunction.glsl"
#include "lib/phong.glsl"

// Density of normals per solid angle; integral of D cos = 1.
float blinnD(vec3 h, float exponent)
{
    float sin2 = h.x * h.x + h.y * h.y;
    return h.z > 0.0 ? (exponent + 2.0) / TWO_PI * exp(0.5 * exponent * logOneMinus(min(sin2, 1.0))) : 0.0;
}

// cos (1 + 2 Lambda), as beckmannRoot(). Slopes along one direction are spread as cos^(n+1) of their angle. The integral of that up
// to a right angle less theta is, in w = sqrt(-2 log sin theta), one of exp(-k w^2) times a factor near 1, here to w^8: within .2 %
// of root for any n >= 0 (Walter's root of Beckmann's makes surfaces of n < 10 reflect up to a third more than they get).
float blinnRoot(float cosTheta, float exponent)
{
    float k = 0.5 * exponent + 0.75;
    float w2 = -logOneMinus(min(cosTheta * cosTheta, 1.0));
    float w = sqrt(w2);
    float gauss = exp(-k * w2);
    float whole = 0.88622692545 / sqrt(k);  // sqrt(pi / k) / 2
    float upTo = whole * errorFunction(sqrt(k) * w);
    float k2 = k * k;
    float fourth = 0.75 / k2 * upTo - gauss * w * (w2 / (2.0 * k) + 0.75 / k2);
    float eighth = 6.5625 / (k2 * k2) * upTo -
                   gauss * w * (w2 * (w2 * (w2 / (2.0 * k) + 1.75 / k2) + 4.375 / (k2 * k)) + 6.5625 / (k2 * k2));
    float all = whole * (1.0 - 0.015625 / k2 + 0.001576 / (k2 * k2));
    float below = upTo - fourth / 48.0 + 0.00024015 * eighth;
    return (cosTheta * below + exp(-0.5 * (exponent + 2.0) * w2) / (exponent + 1.0)) / all;
}

#endif
