// SPDX-License-Identifier: MIT
// What a pixel sees of the lights of the sky shadow atlas in its lobe [specular.md 4].
#ifndef LOBELIGHTS_GLSL
#define LOBELIGHTS_GLSL
#pragma import_defines(HAS_ATLAS)

#include "lib/bsdf.glsl"
#include "lib/limits.glsl"
#include "pass/lobesums.glsl"
#include "pass/lobewidth.glsl"
#ifdef HAS_ATLAS
#include "pass/atlas.glsl"
#endif

// Narrower lobes would see the nearest light alone, and show a step where another becomes the nearest.
const float LEAST_LIT_ROUGHNESS = 0.1;
const int LEAST_NEAR_LIGHTS = 4;

// A pixel's lobe in the frame of the lights.
struct PixelLobe {
    mat3 lightsFromLocal;
    vec3 view;      // local
    Bsdf bsdf;
    float dealt;    // weight of the lights that are not near it: in a narrow lobe's tails a pixel has too few, and they are noise
    int near;       // how many lights near its direction each pixel evaluates
    uvec4 nearest;  // their numbers, two in each component, as in nearestLightMap
    uvec4 further;
    uvec2 nearOwn;  // bit i: light i of the pixel's own group is one of them, 32 lights a component
};

PixelLobe pixelLobe(mat3 lightsFromLocal, vec3 view, Bsdf bsdf)
{
    float dealt = smoothstep(DEALT_ROUGHNESS.x, DEALT_ROUGHNESS.y, evenRoughness(bsdf));
    return PixelLobe(lightsFromLocal, view, bsdf, dealt, 0, uvec4(0u), uvec4(0u), uvec2(0u));
}

// Number of the k-th near light. No component is chosen by an index: software renderers would keep the vector in memory.
int nearLight(PixelLobe lobe, int k)
{
    uvec4 eight = k < 8 ? lobe.nearest : lobe.further;
    uvec2 four = (k & 4) == 0 ? eight.xy : eight.zw;
    return int(((k & 2) == 0 ? four.x : four.y) >> uint(16 * (k & 1)) & 0xffffu);
}

// Whether light i of the pixel's own group is a near one.
bool isNear(PixelLobe lobe, int i)
{
    return ((i < 32 ? lobe.nearOwn.x : lobe.nearOwn.y) >> uint(i & 31) & 1u) != 0u;
}

// flux: of the light, times the cosine; direction: unit; count: of lights that it stands for.
void addToLobe(PixelLobe lobe, vec4 flux, vec3 direction, bool isSeen, float count, inout LobeLights sums)
{
    vec3 l = direction * lobe.lightsFromLocal;
    float alpha = evenAlpha(lobe.bsdf);
    // Times alpha^2, about one over the lobe's peak: the sums are kept in half floats.
    vec3 e = flux.rgb * bsdfLobe(lobe.bsdf, lobe.view, l) * (count * alpha * alpha);
    float s = flux.a * lobeShare(lobe.view, l, lobeAlpha(lobe.bsdf)) * count;
    float seen = isSeen ? 1.0 : 0.0;
    sums.seen += seen * e;
    sums.all += e;
    sums.sky += s * vec2(seen, 1.0);
}

#ifdef HAS_ATLAS
// group: the pixel's own, whose lights are not to be counted twice.
PixelLobe withNearLights(PixelLobe lobe, int group)
{
    ivec2 texel = nearestLightTexel(lobe.lightsFromLocal * vec3(-lobe.view.x, -lobe.view.y, lobe.view.z));
    // As many as lie in a sixteenth of the sphere.
    lobe.near = clamp(textureSize(atlasLightMap, 0).x, LEAST_NEAR_LIGHTS, NEAREST_LIGHTS);
    lobe.nearest = texelFetch(nearestLightMap, texel, 0);
    lobe.further = texelFetch(nearestLightMap, texel + ivec2(1, 0), 0);
    for (int k = 0; k < lobe.near; ++k) {
        int light = nearLight(lobe, k);
        uint bit = light % LIGHT_GROUPS == group ? 1u << uint(light / LIGHT_GROUPS & 31) : 0u;
        if (light < 32 * LIGHT_GROUPS)
            lobe.nearOwn.x |= bit;
        else
            lobe.nearOwn.y |= bit;
    }
    return lobe;
}

// point, normal: of the surface, in the frame of the lights. facet: normal of its plane, which the maps show.
void addNearLights(PixelLobe lobe, vec3 point, vec3 normal, vec3 facet, inout LobeLights sums)
{
    for (int k = 0; k < lobe.near; ++k) {
        int number = nearLight(lobe, k);
        AtlasLight light = atlasLight(number % LIGHT_GROUPS, number / LIGHT_GROUPS);
        float c = dot(normal, light.direction);
        if (c <= 0.0) continue;
        // At the rim of round bodies the maps' texels hide the surface from lights that graze it.
        bool seen = atlasSees(light, point, facet) > 0.5;
        addToLobe(lobe, c * vec4(light.flux, light.solidAngle), light.direction, seen, smoothstep(0.0, 0.1, c), sums);
    }
}
#endif

#endif
