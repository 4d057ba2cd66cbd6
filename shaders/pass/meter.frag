#version 330 compatibility
// SPDX-License-Identifier: MIT
// First step to the exposure: how much light the surfaces in view receive. The picture is divided into parts. Each texel sums
// meteredLight() over a few pixels that are spread evenly over its part.

#pragma import_defines(HAS_CATCHERS)

#include "lib/limits.glsl"
#include "lib/metering.glsl"
#include "lib/tone.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightmark.glsl"

uniform sampler2D emissionMap;
uniform sampler2D radianceMap;

layout(location = 0) out vec2 metered;

float reflectance(ivec2 p)
{
    vec3 diffuse = texelFetch(albedoMap, p, 0).rgb;
    bool coated = kindBrdf(pixelKind(p)) == BRDF_COATED;  // albedoMap has all of what is below the coat
    return luminance(coated ? diffuse : diffuse + texelFetch(specularMap, p, 0).rgb);
}

// Light is not metered on shadow catchers, the background and area lights' own surfaces.
bool isLeftOut(ivec2 p)
{
#ifdef HAS_CATCHERS
    if (isShadowCatcher(p)) return true;
#endif
    return isBackground(p) || isAreaLight(emissionMap, p);
}

void main()
{
    metered = vec2(0.0);
    ivec2 size = textureSize(depthMap, 0);  // viewportSize is this picture's
    ivec2 first = ivec2(gl_FragCoord.xy) * METER_POINTS;
    for (int y = 0; y < METER_POINTS; ++y)
        for (int x = 0; x < METER_POINTS; ++x) {
            ivec2 p = (2 * (first + ivec2(x, y)) + 1) * size / (2 * METER_SIDE * METER_POINTS);
            if (isLeftOut(p)) continue;
            metered += meteredLight(luminance(texelFetch(radianceMap, p, 0).rgb), reflectance(p));
        }
}
