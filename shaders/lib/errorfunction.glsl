// SPDX-License-Identifier: MIT
#ifndef ERRORFUNCTION_GLSL
#define ERRORFUNCTION_GLSL

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

#endif
