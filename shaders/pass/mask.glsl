// SPDX-License-Identifier: MIT
// A mask is black where the surface has holes, or transparent.
#ifndef MASK_GLSL
#define MASK_GLSL

bool maskIsOpen(vec4 texel)
{
    return min(texel.r, texel.a) < 0.5;
}

#endif
