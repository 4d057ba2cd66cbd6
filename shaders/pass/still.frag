#version 330 compatibility
// SPDX-License-Identifier: MIT
// The picture of a frame as it is shown, kept while the average of a still view is young.
#pragma import_defines(HAS_DIFFUSE, HAS_SUNS, HAS_SUN_SHADOWS, HAS_SPECULAR, HAS_OCCLUSION, HAS_BOUNCE, HAS_LOBES, COMBINE_SUBTRACT, BACKGROUND, BACKGROUND_BLUR)

#include "pass/picture.glsl"

layout(location = 0) out vec4 picture;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    picture = pictureRadiance(p, mapFromEye * viewRay(inverseProjection, pixelNdc(p)));
}
