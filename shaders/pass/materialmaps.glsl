// SPDX-License-Identifier: MIT
// Textures of osgEnvLight::Material beside the base colour, each with coordinates of its own.
#ifndef MATERIALMAPS_GLSL
#define MATERIALMAPS_GLSL
#pragma import_defines(NORMAL_MAP, METAL_ROUGH_MAP, EMISSION_MAP, COAT_MAP, COAT_ROUGHNESS_MAP, COAT_NORMAL_MAP, ENVLIGHT_ANISOTROPY, ANISOTROPY_MAP, VERTEX_TANGENTS, TEXTURE_STAGES)

#if defined(NORMAL_MAP) || defined(METAL_ROUGH_MAP) || defined(EMISSION_MAP) || defined(ENVLIGHT_ANISOTROPY)
#define HAS_MAPS
#endif
#if defined(COAT_MAP) || defined(COAT_ROUGHNESS_MAP) || defined(COAT_NORMAL_MAP)
#define HAS_MAPS
#endif

#ifdef HAS_MAPS
in vec4 mapCoordinates;  // of the arrays 0 and 1

vec2 mapCoordinate(int set, mat3 transform)
{
    return vec2(transform * vec3(set == 1 ? mapCoordinates.zw : mapCoordinates.xy, 1.0));
}
#endif

#if defined(NORMAL_MAP) || defined(COAT_NORMAL_MAP) || defined(ENVLIGHT_ANISOTROPY) || defined(TEXTURE_STAGES)
// Directions on a surface: to the right and to the top of a picture that is mapped onto it. Their lengths are 1 at most; 0 means that there
// are none.
struct Tangents {
    vec3 right;
    vec3 up;
};

// Tangents by the texture coordinates st: the directions in which these grow, in the plane of the unit normal n [Schueler, GPU Pro 4
// (2013)]. The longer one has length 1. up: -1 if the second coordinate is 0 at the picture's top.
Tangents coordinateTangents(vec3 n, vec3 eye, vec2 st, float up)
{
    vec3 across = cross(dFdy(eye), n);
    vec3 along = cross(n, dFdx(eye));
    vec3 s = across * dFdx(st).x + along * dFdy(st).x;
    vec3 t = across * dFdx(st).y + along * dFdy(st).y;
    float size2 = max(dot(s, s), dot(t, t));
    float scale = size2 > 0.0 ? inversesqrt(size2) : 0.0;
    return Tangents(scale * s, (up < 0.0 ? -scale : scale) * t);
}

// The unit normal n as a texel bends it; n where there are no tangents.
vec3 bentNormal(vec3 n, Tangents tangents, vec3 texel, float scale)
{
    if (tangents.right == vec3(0.0) && tangents.up == vec3(0.0)) return n;
    vec3 m = texel * 2.0 - 1.0;
    vec3 bent = scale * (m.x * tangents.right + m.y * tangents.up) + m.z * n;
    float size = length(bent);
    return size > 0.0 ? bent / size : n;
}
#endif

#if defined(NORMAL_MAP) || defined(COAT_NORMAL_MAP) || defined(ENVLIGHT_ANISOTROPY)
#ifdef VERTEX_TANGENTS
in vec3 eyeTangent;
in vec3 eyeBitangent;
#endif

// The vertices' own, if they have any.
Tangents mapTangents(vec3 n, vec3 eye, vec2 st, float up)
{
#ifdef VERTEX_TANGENTS
    return Tangents(eyeTangent / max(length(eyeTangent), 1e-20), eyeBitangent / max(length(eyeBitangent), 1e-20));
#else
    return coordinateTangents(n, eye, st, up);
#endif
}
#endif

#ifdef NORMAL_MAP
uniform sampler2D envlightNormalMap;
uniform int envlightNormalMapTexCoord;
uniform mat3 envlightNormalMapTransform;
uniform float envlightNormalScale;
uniform float envlightNormalUp;

vec3 mappedNormal(vec3 n, vec3 eye)
{
    vec2 st = mapCoordinate(envlightNormalMapTexCoord, envlightNormalMapTransform);
    return bentNormal(n, mapTangents(n, eye, st, envlightNormalUp), texture(envlightNormalMap, st).xyz, envlightNormalScale);
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

#ifdef ENVLIGHT_ANISOTROPY
uniform float envlightAnisotropy;
uniform vec2 envlightAnisotropyDirection;  // unit, along the first coordinate and to the picture's top
uniform int envlightAnisotropyTexCoord;
uniform float envlightAnisotropyUp;
#ifdef ANISOTROPY_MAP
uniform sampler2D envlightAnisotropyMap;
uniform int envlightAnisotropyMapTexCoord;
uniform mat3 envlightAnisotropyMapTransform;
#endif

// xyz: the direction in which highlights are drawn out, in the plane of the unit normal n, of any length. w: the strength. A surface without
// texture coordinates is brushed as on a lathe, around the z axis of its geometry.
vec4 surfaceAnisotropy(vec3 n, vec3 eye)
{
    vec2 d = envlightAnisotropyDirection;
    float strength = envlightAnisotropy;
    vec2 st = envlightAnisotropyTexCoord == 1 ? mapCoordinates.zw : mapCoordinates.xy;
#ifdef ANISOTROPY_MAP
    vec3 texel = texture(envlightAnisotropyMap, mapCoordinate(envlightAnisotropyMapTexCoord, envlightAnisotropyMapTransform)).rgb;
    vec2 turn = texel.rg * 2.0 - 1.0;
    d = vec2(d.x * turn.x - d.y * turn.y, d.x * turn.y + d.y * turn.x);
    strength *= texel.b;
#endif
    Tangents tangents = mapTangents(n, eye, st, envlightAnisotropyUp);
#ifdef VERTEX_TANGENTS
    vec3 t = tangents.right - dot(tangents.right, n) * n;
#else
    vec3 t = cross(tangents.up, n);  // along a line of equal second coordinates
    if (dot(t, tangents.right) < 0.0) t = -t;
#endif
    bool mapped = dot(t, t) > 0.0;
    if (!mapped) t = cross(gl_ModelViewMatrix[2].xyz, n);
    t /= max(length(t), 1e-20);
    vec3 b = cross(n, t);
    if (mapped && dot(b, tangents.up) < 0.0) b = -b;
    return vec4(d.x * t + d.y * b, strength);
}
#endif

#ifdef COAT_MAP
uniform sampler2D envlightCoatMap;
uniform int envlightCoatMapTexCoord;
uniform mat3 envlightCoatMapTransform;

// Factor of the coat's strength.
float mappedCoat()
{
    return texture(envlightCoatMap, mapCoordinate(envlightCoatMapTexCoord, envlightCoatMapTransform)).r;
}
#endif

#ifdef COAT_ROUGHNESS_MAP
uniform sampler2D envlightCoatRoughnessMap;
uniform int envlightCoatRoughnessMapTexCoord;
uniform mat3 envlightCoatRoughnessMapTransform;

// Factor of the coat's roughness.
float mappedCoatRoughness()
{
    vec2 st = mapCoordinate(envlightCoatRoughnessMapTexCoord, envlightCoatRoughnessMapTransform);
    return texture(envlightCoatRoughnessMap, st).g;
}
#endif

#ifdef COAT_NORMAL_MAP
uniform sampler2D envlightCoatNormalMap;
uniform int envlightCoatNormalMapTexCoord;
uniform mat3 envlightCoatNormalMapTransform;
uniform float envlightCoatNormalScale;
uniform float envlightCoatNormalUp;

vec3 mappedCoatNormal(vec3 n, vec3 eye)
{
    vec2 st = mapCoordinate(envlightCoatNormalMapTexCoord, envlightCoatNormalMapTransform);
    return bentNormal(n, mapTangents(n, eye, st, envlightCoatNormalUp), texture(envlightCoatNormalMap, st).xyz, envlightCoatNormalScale);
}
#endif

#endif
