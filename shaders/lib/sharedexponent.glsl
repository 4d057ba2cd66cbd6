// SPDX-License-Identifier: MIT
// Three numbers from 0 to 65408 in 32 bits: nine of each and an exponent that they share, as OpenGL's format RGB9_E5 keeps them.
#ifndef SHAREDEXPONENT_GLSL
#define SHAREDEXPONENT_GLSL

uint packSharedExponent(vec3 c)
{
    const float most = 65408.0;
    float largest = min(max(c.x, max(c.y, c.z)), most);
    float exponent = clamp(floor(log2(max(largest, 1e-20))) + 1.0, -15.0, 16.0);
    if (floor(largest * exp2(9.0 - exponent) + 0.5) >= 512.0) exponent += 1.0;
    float scale = exp2(9.0 - exponent);
    uint r = uint(clamp(c.x, 0.0, most) * scale + 0.5);
    uint g = uint(clamp(c.y, 0.0, most) * scale + 0.5);
    uint b = uint(clamp(c.z, 0.0, most) * scale + 0.5);
    return r | g << 9 | b << 18 | uint(exponent + 15.0) << 27;
}

vec3 unpackSharedExponent(uint code)
{
    float scale = exp2(float(code >> 27) - 24.0);
    return scale * vec3(float(code & 511u), float(code >> 9 & 511u), float(code >> 18 & 511u));
}

#endif
