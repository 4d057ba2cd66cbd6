#version 330 compatibility
// SPDX-License-Identifier: MIT
// Fills the G-buffer.
#include "pass/fillgbuffer.glsl"

void main()
{
    fillGBuffer(readSurface());
}
