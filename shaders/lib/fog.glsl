// SPDX-License-Identifier: MIT
// What fog leaves of the light over a distance, as OpenGL's fixed function has it [OpenGL 2.1, 3.10].
#ifndef FOG_GLSL
#define FOG_GLSL

const int FOG_NONE = 0;
const int FOG_LINEAR = 1;
const int FOG_EXP = 2;
const int FOG_EXP2 = 3;

// start and end are of linear fog, density is of the exponential ones. Past a start that is no nearer than the end, there is nothing.
float fogTransmittance(int kind, float distance, float density, float start, float end)
{
    if (kind == FOG_LINEAR) {
        if (end <= start) return distance < end ? 1.0 : 0.0;
        return clamp((end - distance) / (end - start), 0.0, 1.0);
    }
    float depth = max(density * distance, 0.0);
    return exp(kind == FOG_EXP2 ? -min(depth * depth, 1e4) : -min(depth, 1e4));
}

#endif
