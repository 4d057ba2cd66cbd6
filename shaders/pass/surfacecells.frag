#version 330 compatibility
// SPDX-License-Identifier: MIT
// The light that surfaces receive in each cell and facing of SurfaceCells, as radiance that a white one sends on: what the points there
// send, over what they reflect. In units of the map's mean, times alpha: how surely there are such surfaces.
#pragma import_defines(HAS_EMISSION, HAS_GLOSS)

#include "lib/limits.glsl"
#include "pass/hostcolor.glsl"

uniform sampler2D cellPointMap;
uniform sampler2D pointRadianceMap;
uniform sampler2D pointDiffuseMap;
#ifdef HAS_GLOSS
uniform sampler2D pointGlossyMap;
#endif
#ifdef HAS_EMISSION
uniform sampler2D pointEmissionMap;
uniform float radianceScale;
#endif

layout(location = 0) out vec4 light;

const float SURE = 4.0;  // weight of parts; where surfaces fill a cell it is about 18

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    const int texels = CELL_POINTS / 4;
    vec3 sent = vec3(0.0);
    vec3 reflected = vec3(0.0);
    float weights = 0.0;
    for (int k = 0; k < CELL_POINTS; ++k) {
        int texel = 2 * texels * p.x + k / 4;
        int number = int(texelFetch(cellPointMap, ivec2(texel, p.y), 0)[k & 3]);
        float weight = texelFetch(cellPointMap, ivec2(texel + texels, p.y), 0)[k & 3];
        ivec2 q = ivec2(number % POINT_SIDE, number / POINT_SIDE);
        vec3 radiance = texelFetch(pointRadianceMap, q, 0).rgb;
        vec3 reflectance = texelFetch(pointDiffuseMap, q, 0).rgb;
#ifdef HAS_EMISSION
        radiance -= texelFetch(pointEmissionMap, q, 0).rgb * ((materialColors == 0 ? exp2(emittedStops) : 1.0) / radianceScale);
#endif
#ifdef HAS_GLOSS
        reflectance += texelFetch(pointGlossyMap, q, 0).rgb;
#endif
        sent += weight * max(radiance, vec3(0.0));
        reflected += weight * reflectance;
        weights += weight;
    }
    float sure = min(weights / SURE, 1.0);
    light = vec4(sure * sent / max(reflected, vec3(1e-20)), sure);
}
