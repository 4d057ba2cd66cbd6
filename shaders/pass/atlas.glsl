// SPDX-License-Identifier: MIT
// The lights of the sky shadow atlas, in the world about its origin.
#ifndef PASS_ATLAS_GLSL
#define PASS_ATLAS_GLSL
#pragma import_defines(HAS_NEIGHBOURHOOD)

#include "lib/atlas.glsl"
#include "lib/limits.glsl"
#include "lib/octahedral.glsl"

uniform sampler2D atlasMap;
uniform sampler2D atlasLightMap; // rows 4q .. 4q + 3 of group q: texels across, texels up, height, each with its
                                 // offset, and flux with the solid angle, negative where there is no map yet
uniform usampler2D nearestLightMap; // ShadowAtlas::nearestImage()
uniform int atlasSize;           // of a map, in texels
uniform float atlasShare;        // one over that
uniform float atlasTexel;        // its side in the world
uniform mat4 atlasFromEye;
#ifdef HAS_NEIGHBOURHOOD
uniform sampler2D finerAtlasMap; // of what lies about the view; its rows of atlasLightMap follow from 4 LIGHT_GROUPS on, the last with 1,
                                 // or -1 where there is no map of that light yet
uniform vec4 neighbourhood;      // centre and radius of what it shows
uniform float neighbourhoodTexel;
#endif

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
    float height = inversesqrt(dot(light.direction, light.direction));  // of the map, in the world
    light.direction *= height;
    light.texel = sign(flux.a) * height * atlasShare;
    light.index = i;
    light.group = group;
    return light;
}

// Where nearestLightMap begins to name the lights nearest to a direction.
ivec2 nearestLightTexel(vec3 direction)
{
    int side = textureSize(nearestLightMap, 0).y;
    ivec2 cell = min(ivec2(octahedralFromDirection(direction) * float(side)), side - 1);
    return ivec2(2 * cell.x, cell.y);
}

// A point of a surface as a map shows it.
struct AtlasPlace {
    vec3 position;  // in texels, and height
    vec2 plane;     // how the surface rises
};

AtlasPlace atlasPlace(ivec2 row, vec3 p, vec3 n)
{
    mat3x4 toMap = mat3x4(texelFetch(atlasLightMap, row, 0), texelFetch(atlasLightMap, row + ivec2(0, 1), 0),
                          texelFetch(atlasLightMap, row + ivec2(0, 2), 0));
    // Positions are atlasSize times as fine as heights, and normals go by the inverse.
    vec3 normal = vec4(n, 0.0) * toMap * vec3(atlasShare * atlasShare, atlasShare * atlasShare, 1.0);
    return AtlasPlace(vec4(p, 1.0) * toMap, planeGradient(normal));
}

ivec2 atlasCorner(sampler2D maps, int map)
{
    int columns = textureSize(maps, 0).x / atlasSize;
    return ivec2(map % columns, map / columns) * atlasSize;
}

#ifdef HAS_NEIGHBOURHOOD
// 1 or 0 as a map of the neighbourhood says; negative: it does not know.
float neighbourhoodSees(AtlasLight light, vec3 p, vec3 n, float cosine)
{
    int map = 16 * light.index + light.group;
    // Each light's ends elsewhere: the two atlases go over into each other.
    float end = mix(0.8, 1.0, fract(float(map) * 0.61803399));
    if (length(p - neighbourhood.xyz) >= end * neighbourhood.w) return -1.0;
    ivec2 row = ivec2(light.index, 4 * (LIGHT_GROUPS + light.group));
    if (texelFetch(atlasLightMap, row + ivec2(0, 3), 0).a < 0.0) return -1.0;
    AtlasPlace place = atlasPlace(row, atlasLookupPoint(p, n, cosine, neighbourhoodTexel), n);
    // A map may still be where the neighbourhood was before.
    vec3 extent = vec3(atlasSize, atlasSize, 1.0);
    if (any(lessThan(place.position, vec3(0.0))) || any(greaterThanEqual(place.position, extent))) return -1.0;
    return atlasVisible(finerAtlasMap, atlasCorner(finerAtlasMap, map), atlasSize, place.position.xy, place.position.z, place.plane);
}
#endif

// Side of the texels that a point is looked up in.
float atlasTexelAt(vec3 p)
{
#ifdef HAS_NEIGHBOURHOOD
    return mix(neighbourhoodTexel, atlasTexel, smoothstep(0.8, 1.0, length(p - neighbourhood.xyz) / neighbourhood.w));
#else
    return atlasTexel;
#endif
}

// 1 if the light is seen from p with unit normal n, else 0.
float atlasSees(AtlasLight light, vec3 p, vec3 n)
{
    if (light.texel < 0.0) return 1.0;
    float cosine = max(dot(n, light.direction), 0.0);
#ifdef HAS_NEIGHBOURHOOD
    float seen = neighbourhoodSees(light, p, n, cosine);
    if (seen >= 0.0) return seen;
#endif
    AtlasPlace place = atlasPlace(ivec2(light.index, 4 * light.group), atlasLookupPoint(p, n, cosine, light.texel), n);
    ivec2 corner = atlasCorner(atlasMap, 16 * light.index + light.group);
    return atlasVisible(atlasMap, corner, atlasSize, place.position.xy, place.position.z, place.plane);
}

#endif
