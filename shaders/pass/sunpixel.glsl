// SPDX-License-Identifier: MIT
// The surface in a pixel of the G-buffer, as the suns' shadow maps are asked about it.
#ifndef SUNPIXEL_GLSL
#define SUNPIXEL_GLSL

#include "pass/gbuffer.glsl"
#include "pass/sunshadow.glsl"

uniform mat4 atlasFromEye;
uniform sampler2D emissionMap;

SunPixel sunPixel(ivec2 p)
{
    float depth = texelFetch(depthMap, p, 0).r;
    vec2 ndc = pixelNdc(p);
    vec3 eye = eyeFromDepth(inverseProjection, ndc, depth);
    SunPixel s;
    s.point = vec3(atlasFromEye * vec4(eye, 1.0));
    s.normal = mat3(atlasFromEye) * pixelNormal(p);
    float bulge = abs(texelFetch(emissionMap, p, 0).a);
    s.bulge = bulge < 0.5 ? bulge * length(eye) : 0.0;  // programs of the host's own may write 1
    s.ray = mat3(atlasFromEye) * viewRay(inverseProjection, ndc);
    s.quantum = length(depthStep(inverseProjection, ndc, depth));
    s.footprint = pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    s.group = bayer4(p.x, p.y);
    return s;
}

// The width of a penumbra in pixels, negative where the pixels of a 2x2 quad differ.
float markedWidth(float width, bool differs)
{
    return differs ? -1.0 - width : width;
}

float penumbraWidth(float marked)
{
    return marked < 0.0 ? -1.0 - marked : marked;
}

#endif
