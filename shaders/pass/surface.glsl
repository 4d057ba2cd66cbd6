// SPDX-License-Identifier: MIT
// What the host's fixed-function state, or our Material, says of the surface at this fragment. Colours given as numbers
// are linear; colours in 8-bit images are sRGB encoded.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#pragma import_defines(ENVLIGHT_COOK_TORRANCE, ENVLIGHT_LAMBERT, ENVLIGHT_PHONG, FACE_NORMAL, VERTEX_COLOR, UNLIT, NO_TEXTURE, LINEAR_TEXTURE, TEXTURE_REPLACE, PHONG_MATERIAL)

#include "lib/depth.glsl"
#include "lib/phong.glsl"
#include "lib/tone.glsl"
#include "pass/brdf.glsl"

uniform sampler2D baseColorMap;

#ifdef ENVLIGHT_COOK_TORRANCE
uniform vec3 envlightBaseColor;
uniform float envlightMetalness;
uniform float envlightRoughness;
#endif
#if defined(ENVLIGHT_LAMBERT) || defined(ENVLIGHT_PHONG)
uniform vec3 envlightDiffuse;
#endif
#ifdef ENVLIGHT_PHONG
uniform vec3 envlightSpecular;
uniform float envlightExponent;
#endif

in vec3 eyePosition;
in vec3 eyeNormal;
in vec4 vertexColor;
in vec2 textureCoordinate;

struct Surface {
    vec3 albedo;     // of the Lambert term
    float alpha;     // coverage
    vec3 ray;        // eye space, unit, away from the eye
    vec3 normal;     // eye space, unit, against the ray
    float roughness; // of the lobe
    vec3 f0;         // colour of the lobe at normal incidence
    int brdf;        // BRDF_LAMBERT, BRDF_PHONG, BRDF_COOK_TORRANCE
    vec3 emission;   // radiance
};

// Unit normal on the side that the view ray meets. The facet's own side decides, not gl_FrontFacing, which a mirroring
// transform inverts.
vec3 surfaceNormal(vec3 ray)
{
    vec3 facet = cross(dFdx(eyePosition), dFdy(eyePosition));
    float facetLength = length(facet);
    facet = facetLength > 0.0 ? facet / facetLength : vec3(0.0, 0.0, 1.0);
    if (dot(facet, ray) > 0.0) facet = -facet;
#ifdef FACE_NORMAL
    return facet;
#else
    float normalLength = length(eyeNormal);
    if (!(normalLength > 0.0)) return facet;
    vec3 n = eyeNormal / normalLength;
    return dot(n, facet) < 0.0 ? -n : n;
#endif
}

// Colour and alpha of material, vertices and texture unit 0, as TexEnv combines them.
vec4 surfaceColor(vec4 material)
{
    vec4 base = material;
#ifdef VERTEX_COLOR
    base = vertexColor;
#endif
#ifdef UNLIT
    base.rgb = srgbDecode3(base.rgb);
#endif
#ifndef NO_TEXTURE
    vec4 texel = texture(baseColorMap, textureCoordinate);
#ifndef LINEAR_TEXTURE
    texel.rgb = srgbDecode3(texel.rgb);
#endif
#ifdef TEXTURE_REPLACE
    base = texel;
#else
    base *= texel;
#endif
#endif
    return base;
}

Surface readSurface()
{
    Surface s;
    s.ray = viewRayAt(gl_ProjectionMatrixInverse, eyePosition);
    s.normal = surfaceNormal(s.ray);
    s.roughness = 1.0;
    s.f0 = vec3(0.0);
    s.brdf = BRDF_LAMBERT;
    s.emission = gl_FrontMaterial.emission.rgb;
    vec4 material = gl_FrontMaterial.diffuse;
#ifdef ENVLIGHT_COOK_TORRANCE
    material.rgb = envlightBaseColor;
#endif
#if defined(ENVLIGHT_LAMBERT) || defined(ENVLIGHT_PHONG)
    material.rgb = envlightDiffuse;
#endif
    vec4 base = surfaceColor(material);
    s.alpha = base.a;
    s.albedo = base.rgb;
#if defined(UNLIT)
    s.emission = base.rgb;
    s.albedo = vec3(0.0);
#elif defined(ENVLIGHT_COOK_TORRANCE)
    s.brdf = BRDF_COOK_TORRANCE;
    s.albedo = base.rgb * (1.0 - envlightMetalness);
    s.f0 = mix(vec3(0.04), base.rgb, envlightMetalness);
    s.roughness = envlightRoughness;
#elif defined(ENVLIGHT_PHONG)
    s.brdf = BRDF_PHONG;
    s.f0 = envlightSpecular;
    s.roughness = phongRoughness(envlightExponent);
#elif defined(PHONG_MATERIAL)
    // Legacy materials reflect more than they receive: both terms are scaled until diffuse + specular <= 1.
    s.brdf = BRDF_PHONG;
    s.f0 = gl_FrontMaterial.specular.rgb;
    vec3 sum = s.albedo + s.f0;
    float scale = 1.0 / max(1.0, max(sum.r, max(sum.g, sum.b)));
    s.albedo *= scale;
    s.f0 *= scale;
    s.roughness = phongRoughness(gl_FrontMaterial.shininess);
#endif
    return s;
}

#endif
