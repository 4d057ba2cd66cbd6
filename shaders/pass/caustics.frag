#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// Caustics: the light that polished metal reflects on other surfaces. Each pixel of a 4x4 cell sums its own group of the virtual lights;
// the filter averages the groups [seed 004, 2.4; Segovia et al. 2006].
#include "lib/sequence.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightsums.glsl"
#include "pass/virtuallights.glsl"

uniform mat4 atlasFromEye;  // to the lights' origin

// Half width of the narrowest lobe, in cells. One pixel of a cell asks a light for all of the cell.
const float CELL_SHARE = 0.5;

layout(location = 0) out uvec4 sumsTexel;
layout(location = 1) out uvec4 placeTexel;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 eye = pixelEye(p);
    vec3 eyeNormal = pixelNormal(p);
    vec3 place = vec3(atlasFromEye * vec4(eye, 1.0));
    vec3 n = mat3(atlasFromEye) * eyeNormal;
    int group = bayer4(p.x, p.y);
    float width = CELL_SHARE * 4.0 * pixelFootprint(inverseProjection, pixelNdc(p), texelFetch(depthMap, p, 0).r, viewportSize);
    int count = textureSize(virtualLightMap, 0).x / LIGHT_GROUPS;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) sum += fromVirtualLight(group * count + i, place, n, width);
    sumsTexel = packSums(LightSums(vec4(0.0), vec4(sum, 0.0)));
    SumsPlace at;
    at.normal = eyeNormal;
    at.facet = pixelFacet(p, eye, eyeNormal);
    at.depth = texelFetch(depthMap, p, 0).r;
    placeTexel = packPlace(at);
}
