// SPDX-License-Identifier: MIT
// The share of the map that the first frame of a still view took for visible in a lobe, per colour: with S in its alpha, in 24 bits that a
// float holds exactly. Later frames add what corrects it; they err less, the more exact it is.
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
