#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// What area lights a pixel sees: it takes a sixteenth of their points and sums what these send to it, those that it sees (num) and all
// (den) [area-lights.md 5, "O pass"]. The filter averages both over a 4x4 cell; their ratio dims the closed forms. Alpha: the same sums,
// weighted by the pixel's lobe. A light with a picture has its mean radiance in den, so that the ratio also holds the picture's colours.
#pragma import_defines(HAS_LOBES, HAS_AREA_PICTURES)

#include "lib/frame.glsl"
#include "lib/limits.glsl"
#include "lib/sequence.glsl"
#include "pass/emitterpoints.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightsums.glsl"
#ifdef HAS_LOBES
#include "pass/pixelbsdf.glsl"
#endif

uniform mat4 atlasFromEye;

layout(location = 0) out uvec4 sumsTexel;
layout(location = 1) out uvec4 placeTexel;

#ifdef HAS_LOBES
// A narrower lobe meets too few of the points. With .1, .2, .3, .5 three metals before a screen have an error (tRMSE) of 4.65, 4.28, 4.49 and
// 5.41 % [tests/bench/area_study].
const float LEAST_ROUGHNESS = 0.2;
// Of the lobe's weights beside those of the diffuse layer, for half floats.
const float LOBE_SCALE = 0.0625;

struct AreaLobe {
    mat3 eyeFromLocal;
    vec3 view;
    Bsdf bsdf;
};

AreaLobe areaLobe(ivec2 p, vec3 n)
{
    AreaLobe lobe;
    lobe.eyeFromLocal = pixelFrame(p, n);
    lobe.view = pixelView(p, lobe.eyeFromLocal);
    lobe.bsdf = pixelBsdf(p, lobe.view);
    lobe.bsdf.roughness = max(lobe.bsdf.roughness, LEAST_ROUGHNESS);
    return lobe;
}

float lobeWeight(AreaLobe lobe, vec3 eyeDirection)
{
    return LOBE_SCALE * dot(bsdfLobe(lobe.bsdf, lobe.view, transpose(lobe.eyeFromLocal) * eyeDirection), vec3(1.0 / 3.0));
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 eye = pixelEye(p);
    vec3 eyeNormal = pixelNormal(p);
    vec3 point = vec3(atlasFromEye * vec4(eye, 1.0));
    vec3 normal = mat3(atlasFromEye) * eyeNormal;
    int group = bayer4(p.x, p.y);
    int count = textureSize(emitterPointMap, 0).x / LIGHT_GROUPS;
#ifdef HAS_LOBES
    AreaLobe lobe = areaLobe(p, eyeNormal);
#endif
    LightSums sums = LightSums(vec4(0.0), vec4(0.0));
    for (int q = 0; q < count; ++q) {
        // Neighbours' points of one light lie apart.
        EmitterPoint e = emitterPoint(LIGHT_GROUPS * q + ((group + 7 * q) & (LIGHT_GROUPS - 1)));
        vec3 to = e.position - point;
        float kernel = emitterKernel(e, to, normal);
        if (kernel <= 0.0) continue;
        float seen = emitterSees(e, point, normal);
        if (seen < 0.0) continue;
        vec4 w = vec4(e.power, 0.0) * (kernel * e.scale);
#ifdef HAS_LOBES
        w.a = dot(w.rgb, vec3(1.0 / 3.0)) * lobeWeight(lobe, transpose(mat3(atlasFromEye)) * normalize(to));
#endif
        sums.num += seen * w;
#ifdef HAS_AREA_PICTURES
        w.rgb = evenPower(e) * (kernel * e.scale);
#endif
        sums.den += w;
    }
    sumsTexel = packSums(sums);
    SumsPlace place;
    place.normal = eyeNormal;
    place.facet = pixelFacet(p, eye, eyeNormal);
    place.depth = texelFetch(depthMap, p, 0).r;
    placeTexel = packPlace(place);
}
