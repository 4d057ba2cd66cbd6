#version 330 compatibility
// SPDX-License-Identifier: MIT
// A cell of SurfaceCells knows the light that its surfaces receive, for each way to face: the radiance that a white one would send on. It
// is what the cell's points send, divided by what they reflect. The unit is the map's mean. Alpha says how surely the cell has such a
// surface; the colour is multiplied by it.
#pragma import_defines(HAS_EMISSION, HAS_GLOSS)

#include "lib/limits.glsl"
#include "pass/hostcolor.glsl"
#include "pass/pointlink.glsl"

uniform sampler2D cellPointMap;
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
        ivec2 q = pointTexel(number);
        vec3 radiance = texelFetch(pointRadianceMap, q, 0).rgb;
        vec3 reflectance = texelFetch(pointDiffuseMap, q, 0).rgb;
#ifdef HAS_EMISSION
        radiance -= texelFetch(pointEmissionMap, q, 0).rgb * (emittedScale() / radianceScale);
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
