// SPDX-License-Identifier: MIT
// The first frame of a still view estimates which share of the map a lobe sees, for each colour. The alpha of S keeps it, in 24 bits, which
// a float holds exactly. S is multiplied by it, and later frames add corrections. The better the estimate, the less noise these have.
#ifndef LOBESHOWN_GLSL
#define LOBESHOWN_GLSL

float packShown(vec3 share)
{
    vec3 steps = floor(clamp(share, 0.0, 1.0) * 255.0 + 0.5);
    return steps.r + 256.0 * steps.g + 65536.0 * steps.b;
}

vec3 unpackShown(float code)
{
    float b = floor(code / 65536.0);
    float g = floor((code - 65536.0 * b) / 256.0);
    return vec3(code - 65536.0 * b - 256.0 * g, g, b) / 255.0;
}

#endif
