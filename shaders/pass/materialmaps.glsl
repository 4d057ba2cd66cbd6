// SPDX-License-Identifier: MIT
// Textures of osgEnvLight::Material beside the base colour, each with coordinates of its own.
#ifndef MATERIALMAPS_GLSL
#define MATERIALMAPS_GLSL
#pragma import_defines(NORMAL_MAP, METAL_ROUGH_MAP, EMISSION_MAP)

#if defined(NORMAL_MAP) || defined(METAL_ROUGH_MAP) || defined(EMISSION_MAP)
in vec4 mapCoordinates;  // of the arrays 0 and 1

vec2 mapCoordinate(int set, mat3 transform)
{
    return vec2(transform * vec3(set == 1 ? mapCoordinates.zw : mapCoordinates.xy, 1.0));
}
#endif

#ifdef NORMAL_MAP
uniform sampler2D envlightNormalMap;
uniform int envlightNormalMapTexCoord;
uniform mat3 envlightNormalMapTransform;
uniform float envlightNormalScale;
uniform float envlightNormalUp;  // -1: the second coordinate is 0 at the picture's top

// The unit normal n about which the map turns it, in tangents that follow from the coordinates [Schueler, GPU Pro 4 (2013)];
// n where they do not change.
vec3 mappedNormal(vec3 n, vec3 eye)
{
    vec2 st = mapCoordinate(envlightNormalMapTexCoord, envlightNormalMapTransform);
    vec3 across = cross(dFdy(eye), n);
    vec3 along = cross(n, dFdx(eye));
    vec3 t = across * dFdx(st).x + along * dFdy(st).x;
    vec3 b = across * dFdx(st).y + along * dFdy(st).y;
    float size2 = max(dot(t, t), dot(b, b));
    if (!(size2 > 0.0)) return n;
    vec3 m = texture(envlightNormalMap, st).xyz * 2.0 - 1.0;
    m.xy *= envlightNormalScale * inversesqrt(size2);
    vec3 mapped = m.x * t + (envlightNormalUp < 0.0 ? -m.y : m.y) * b + m.z * n;
    float size = length(mapped);
    return size > 0.0 ? mapped / size : n;
}
#endif

#ifdef METAL_ROUGH_MAP
uniform sampler2D envlightMetalRoughMap;
uniform int envlightMetalRoughMapTexCoord;
uniform mat3 envlightMetalRoughMapTransform;

// Factors of roughness and metalness.
vec2 mappedRoughMetal()
{
    return texture(envlightMetalRoughMap, mapCoordinate(envlightMetalRoughMapTexCoord, envlightMetalRoughMapTransform)).gb;
}
#endif

#ifdef EMISSION_MAP
uniform sampler2D envlightEmissionMap;
uniform int envlightEmissionMapTexCoord;
uniform mat3 envlightEmissionMapTransform;

vec3 mappedEmission()
{
    return srgbDecode3(texture(envlightEmissionMap, mapCoordinate(envlightEmissionMapTexCoord, envlightEmissionMapTransform)).rgb);
}
#endif

#endif
