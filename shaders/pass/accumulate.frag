#version 330 compatibility
// SPDX-License-Identifier: MIT
// One frame of a still view: fresh lights of the map, each with a shadow map of its own, shade the whole BRDF of every pixel
// [occlusion.md 5.1]. Their average over the frames is direct light with the visibility of each direction.
// D = num + V (U - den): U, the term D, is free of their noise, and V is how much of it to trust, a constant of the
// view. The mean is that of num, whatever V is. S is estimated in the same way. V is the share that the first frame saw. Where the lobe
// sees all of the map, or nothing of it, there is no noise.
// A black map's lights only say how much of the sphere is seen.
#pragma import_defines(MAP_IS_BLACK)

#include "lib/tone.glsl"
#include "pass/pixelbsdf.glsl"
#include "pass/atlas.glsl"
#include "pass/lobeshown.glsl"
#include "pass/lobewidth.glsl"
#include "pass/catchers.glsl"
#include "pass/pixelfog.glsl"

uniform float frameWeight;

layout(location = 0) out vec4 sum;      // radiance, coverage
layout(location = 1) out float square;  // of the luminance

struct Lobe {
    mat3 eyeFromLocal;
    vec3 v;
    Bsdf bsdf;
    float share;  // that the lights shade
};

Lobe lobeAt(ivec2 p, vec3 n)
{
    Lobe lobe;
    float roughness = texelFetch(normalMap, p, 0).a;
    lobe.eyeFromLocal = pixelFrame(p, n);
    lobe.v = pixelView(p, lobe.eyeFromLocal);
    lobe.bsdf = pixelBsdf(p, lobe.v);
    lobe.share = lightedShare(roughness);
    return lobe;
}

vec3 surface(ivec2 p)
{
    vec3 n = pixelNormal(p);
    vec3 eye = pixelEye(p);
    vec3 point = vec3(atlasFromEye * vec4(eye, 1.0));
    vec3 facet = mat3(atlasFromEye) * pixelFacet(p, eye, n);
    Lobe lobe = lobeAt(p, n);
#ifdef HAS_ROUGH_DIFFUSE
    RoughDiffuse layer = pixelRoughDiffuse(p, pixelAlbedo(p) * lobe.bsdf.body);
#else
    vec3 rho = pixelAlbedo(p) * texelFetch(diffuseTermMap, p, 0).a;
#endif
    bool isGlossy = lobe.bsdf.brdf != BRDF_LAMBERT && lobe.share > 0.0;
    vec3 num = vec3(0.0);  // from the diffuse layer
    vec3 den = vec3(0.0);
    vec3 shown = unpackShown(texelFetch(specularTermMap, p, 0).a);
    vec3 change = vec3(0.0);  // of the lobe
#ifndef MAP_IS_BLACK
    int lights = textureSize(atlasLightMap, 0).x * LIGHT_GROUPS;
    for (int i = 0; i < lights; ++i) {
        AtlasLight light = atlasLight(i % LIGHT_GROUPS, i / LIGHT_GROUPS);
        vec3 direction = transpose(mat3(atlasFromEye)) * light.direction;
        float c = dot(n, direction);
        if (c <= 0.0) continue;
        vec3 e = light.flux * c;
#ifdef HAS_ROUGH_DIFFUSE
        vec3 d = e * pixelDiffuseBrdf(layer, p, n, direction);
#else
        vec3 d = e * rho;
#endif
        den += d;
        float sees = atlasSees(light, point, facet) > 0.5 ? 1.0 : 0.0;
        num += sees * d;
        if (isGlossy) change += (sees - shown) * e * bsdfLobe(lobe.bsdf, lobe.v, transpose(lobe.eyeFromLocal) * direction);
    }
#endif
    vec3 diffuse = (num - ambientVisibility(p) * den) * (INV_PI * radianceScale) + ambientVisibility(p) * (diffuseTerm(p) + sunDiffuse(p));
    vec3 specular = specularTerm(p) + lobe.share * change * radianceScale;
    return emitted(p) + diffuse + specular + bounce(p);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 radiance = isBackground(p) ? backgroundPicture(p) : surfacePicture(p, throughFog(emissionMap, p, surface(p)));
    float light = luminance(radiance.rgb);
    sum = frameWeight * radiance;
    square = frameWeight * light * light;
}
