#version 330 compatibility
// SPDX-License-Identifier: MIT
// The picture as a display shows it, for the smoothing of its edges: display values, and 1 where there is a surface.

#include "pass/shown.glsl"

layout(location = 0) out vec4 shown;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 picture = shownPicture(p);
    shown = vec4(displayValues(picture.rgb, shownStops(p)), picture.a);
}
