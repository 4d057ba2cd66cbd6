// SPDX-License-Identifier: MIT
// Brushed surfaces: highlights are drawn out along one direction of the surface [KHR_materials_anisotropy; Burley 2012].
#ifndef ANISOTROPY_GLSL
#define ANISOTROPY_GLSL

#include "lib/constants.glsl"

struct Anisotropy {
    float strength;  // 0: none, 1: all along
    float angle;     // of the direction, from the local frame's x; turned by pi it is the same
};

// As 13 bits: strength in steps of 1/31, angle in steps of pi/256. 0: none.
uint packAnisotropy(Anisotropy a)
{
    uint strength = uint(clamp(a.strength, 0.0, 1.0) * 31.0 + 0.5);
    uint angle = uint(fract(a.angle / PI + 1.0) * 256.0 + 0.5) & 255u;
    return strength * 256u + angle;
}

Anisotropy unpackAnisotropy(uint bits)
{
    Anisotropy a;
    a.strength = float(bits / 256u) / 31.0;
    a.angle = float(bits % 256u) * (PI / 256.0);
    return a;
}

// Alphas along the direction and across it. alpha: of the roughness. The least keeps the ratio of both, and so a float's digits.
vec2 anisotropicAlpha(float alpha, float strength)
{
    float across = max(alpha, 1e-4);
    return vec2(mix(across, 1.0, strength * strength), across);
}

// Roughness along the view v and across it, by the slopes of the normals in those directions.
vec2 anisotropicRoughness(vec2 alpha, vec3 v)
{
    vec2 d = vec2(v.x, v.y);
    float s = length(d);
    d = s > 1e-6 ? d / s : vec2(1.0, 0.0);
    return vec2(sqrt(length(alpha * d)), sqrt(length(alpha * vec2(-d.y, d.x))));
}

#endif
