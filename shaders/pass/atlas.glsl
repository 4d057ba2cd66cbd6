// SPDX-License-Identifier: MIT
// The lights of the sky shadow atlas, in the world about its origin.
#ifndef PASS_ATLAS_GLSL
#define PASS_ATLAS_GLSL

#include "lib/atlas.glsl"

uniform sampler2D atlasMap;
uniform sampler2D atlasLightMap; // rows 4q .. 4q + 3 of group q: texels across, texels up, height, each with its
                                 // offset, and flux with the solid angle, negative where there is no map yet
uniform int atlasSize;           // of a map, in texels
uniform float atlasTexel;        // its side in the world
uniform mat4 atlasFromEye;

struct AtlasLight {
    vec3 direction;
    vec3 flux;
    float solidAngle;
    float texel; // of its map, in the world; negative: not drawn yet
    int index;
    int group;
};

AtlasLight atlasLight(int group, int i)
{
    AtlasLight light;
    vec4 flux = texelFetch(atlasLightMap, ivec2(i, 4 * group + 3), 0);
    light.flux = flux.rgb;
    light.solidAngle = abs(flux.a);
    light.direction = texelFetch(atlasLightMap, ivec2(i, 4 * group + 2), 0).xyz;
    float perHeight = length(light.direction);
    light.direction /= perHeight;
    light.texel = sign(flux.a) / (perHeight * float(atlasSize));
    light.index = i;
    light.group = group;
    return light;
}

// 1 if the light is seen from p with unit normal n, else 0. cosine: of the light to n.
float atlasSees(AtlasLight light, vec3 p, vec3 n, float cosine)
{
    if (light.texel < 0.0) return 1.0;
    vec4 q = vec4(atlasLookupPoint(p, n, cosine, light.texel), 1.0);
    ivec2 row = ivec2(light.index, 4 * light.group);
    vec2 xy = vec2(dot(texelFetch(atlasLightMap, row, 0), q), dot(texelFetch(atlasLightMap, row + ivec2(0, 1), 0), q));
    float height = dot(texelFetch(atlasLightMap, row + ivec2(0, 2), 0), q);
    int columns = textureSize(atlasMap, 0).x / atlasSize;
    int map = 16 * light.index + light.group;
    return atlasVisible(atlasMap, ivec2(map % columns, map / columns) * atlasSize, atlasSize, xy, height);
}

#endif
