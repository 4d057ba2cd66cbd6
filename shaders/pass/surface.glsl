// SPDX-License-Identifier: MIT
// What the host's fixed-function state, or our Material, says of the surface at this fragment. Colours of the host's materials
// and of vertices, and of images without floats, are sRGB encoded; those of our Material are linear.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#pragma import_defines(HAS_SUN_MAPS, ENVLIGHT_COOK_TORRANCE, ENVLIGHT_LAMBERT, ENVLIGHT_PHONG, ENVLIGHT_STRAUSS, FACE_NORMAL, VERTEX_COLOR, UNLIT, NO_TEXTURE, LINEAR_TEXTURE, ALPHA_TEXTURE, TEXTURE_REPLACE, TEXTURE_DECAL, TEXTURE_BLEND, TEXTURE_ADD, PAINTED_REFLECTION, PHONG_MATERIAL, TWO_SIDED, ENVLIGHT_EMISSION, ENVLIGHT_DIELECTRIC, ENVLIGHT_CATCHER, ENVLIGHT_COAT, ENVLIGHT_ANISOTROPY, ENVLIGHT_EDGE, ENVLIGHT_ROUGH_DIFFUSE, ENVLIGHT_LIGHT, WHITE)

#include "lib/brdfs.glsl"
#include "lib/bulge.glsl"
#include "lib/coat.glsl"
#include "lib/depth.glsl"
#include "lib/fresnel.glsl"
#include "lib/phong.glsl"
#include "lib/strauss.glsl"
#include "lib/tone.glsl"
#include "pass/hostcolor.glsl"
#include "pass/litsurface.glsl"
#include "pass/materialmaps.glsl"
#include "pass/texturestages.glsl"

uniform sampler2D baseColorMap;

#if defined(ENVLIGHT_COOK_TORRANCE) || defined(ENVLIGHT_PHONG)
uniform int envlightBrdf;  // which of those with these parameters
#endif
#if defined(ENVLIGHT_COOK_TORRANCE) || defined(ENVLIGHT_STRAUSS)
uniform vec3 envlightBaseColor;
uniform float envlightMetalness;
#endif
#ifdef ENVLIGHT_COOK_TORRANCE
uniform float envlightRoughness;
#endif
#ifdef ENVLIGHT_DIELECTRIC
uniform vec3 envlightDielectric;  // reflectance of what is not metal, at normal incidence
#endif
#ifdef ENVLIGHT_EDGE
uniform vec3 envlightEdge;
#endif
#ifdef ENVLIGHT_ROUGH_DIFFUSE
uniform float envlightDiffuseRoughness;
#endif
#ifdef ENVLIGHT_COAT
uniform float envlightCoat;
uniform float envlightCoatRoughness;
#endif
#ifdef ENVLIGHT_STRAUSS
uniform float envlightSmoothness;
#endif
#if defined(ENVLIGHT_LAMBERT) || defined(ENVLIGHT_PHONG)
uniform vec3 envlightDiffuse;
#endif
#ifdef ENVLIGHT_PHONG
uniform vec3 envlightSpecular;
uniform float envlightExponent;
#endif

#ifdef ENVLIGHT_EMISSION
uniform vec3 envlightEmission;
#endif
#ifdef ENVLIGHT_LIGHT
uniform vec3 envlightLight;  // radiance
#endif

in vec3 eyePosition;
in vec3 eyeNormal;
#ifdef HAS_SUN_MAPS
flat in vec3 cornerPosition;
flat in vec3 cornerNormal;
#endif
in vec4 vertexColor;
in vec3 textureCoordinate;  // s, t, q

// Unit normal of the facet, on the side that the view ray meets: that decides, not gl_FrontFacing, which a mirroring transform
// inverts.
vec3 facetNormal(vec3 ray)
{
    vec3 facet = cross(dFdx(eyePosition), dFdy(eyePosition));
    float facetLength = length(facet);
    facet = facetLength > 0.0 ? facet / facetLength : vec3(0.0, 0.0, 1.0);
    return dot(facet, ray) > 0.0 ? -facet : facet;
}

// The unit normal that shades, on the facet's side. At a body's outline front and back have the same depth, and a pixel may show the
// back. The vertices' normals turn away from the eye within that pixel: it gets the normal at which they do.
vec3 surfaceNormal(vec3 facet, vec3 ray)
{
#ifdef FACE_NORMAL
    return facet;
#else
    float normalLength = length(eyeNormal);
    vec3 n = eyeNormal / max(normalLength, 1e-30);
    float away = dot(n, ray);
    float change = fwidth(away);
    if (!(normalLength > 0.0)) return facet;
    if (dot(n, facet) >= 0.0) return n;
    return away < change ? normalize(n - away * ray) : -n;
#endif
}

#if defined(ENVLIGHT_COOK_TORRANCE) || defined(ENVLIGHT_LAMBERT) || defined(ENVLIGHT_PHONG) || defined(ENVLIGHT_STRAUSS)
#define ENVLIGHT_MATERIAL
#endif

#ifndef NO_TEXTURE
vec4 surfaceTexel()
{
    vec4 texel = textureProj(baseColorMap, textureCoordinate);
#ifdef ALPHA_TEXTURE
    texel.rgb = vec3(1.0);
#elif !defined(LINEAR_TEXTURE)
    texel.rgb = srgbDecode3(texel.rgb);
#endif
    return texel;
}

// As TexEnv combines them; sums and mixtures of display values, as the host's own pictures are.
vec4 combined(vec4 base, vec4 texel)
{
#if defined(TEXTURE_REPLACE)
    return texel;
#elif defined(TEXTURE_DECAL)
    return vec4(srgbDecode3(mix(srgbEncode3(base.rgb), srgbEncode3(texel.rgb), texel.a)), base.a);
#elif defined(TEXTURE_BLEND)
    return vec4(srgbDecode3(mix(srgbEncode3(base.rgb), gl_TextureEnvColor[0].rgb, srgbEncode3(texel.rgb))), base.a * texel.a);
#elif defined(TEXTURE_ADD)
    return vec4(srgbDecode3(min(srgbEncode3(base.rgb) + srgbEncode3(texel.rgb), vec3(1.0))), base.a * texel.a);
#else
    return base * texel;
#endif
}
#endif

// Colour and alpha of material, vertices and texture unit 0.
vec4 surfaceColor(vec4 material)
{
    vec4 base = material;
#ifdef VERTEX_COLOR
    base = vertexColor;
#endif
#if !defined(ENVLIGHT_MATERIAL) || defined(VERTEX_COLOR)
    base.rgb = hostColor(base.rgb);
#endif
#ifndef NO_TEXTURE
    base = combined(base, surfaceTexel());
#endif
#ifdef TEXTURE_STAGES
    base = stagedColor(base);
#endif
    return base;
}

gl_MaterialParameters hostMaterial()
{
#ifdef TWO_SIDED
    if (!gl_FrontFacing) return gl_BackMaterial;
#endif
    return gl_FrontMaterial;
}

#if defined(PAINTED_REFLECTION) && !defined(ENVLIGHT_MATERIAL)
// A sphere or cube map that is painted on as a reflection: polished metal, which reflects the map itself.
const float PAINTED_REFLECTANCE = 0.9;
#endif

// In shares of the distance to the eye.
float surfaceBulge(vec3 facet, vec3 normal)
{
#if defined(FACE_NORMAL) || !defined(HAS_SUN_MAPS)
    return 0.0;
#else
    float cornerLength = length(cornerNormal);
    if (!(cornerLength > 0.0)) return 0.0;
    vec3 corner = cornerNormal / cornerLength;
    if (dot(corner, facet) < 0.0) corner = -corner;
    return bulgeAbove(facet, eyePosition, normal, cornerPosition, corner) / max(length(eyePosition), 1e-20);
#endif
}

Surface readSurface()
{
    vec3 ray = viewRayAt(gl_ProjectionMatrixInverse, eyePosition);
    vec3 facet = facetNormal(ray);
    Surface s = blackSurface(eyePosition, ray, surfaceNormal(facet, ray));
    s.bulge = surfaceBulge(facet, s.normal);
#ifdef NORMAL_MAP
    s.normal = mappedNormal(s.normal, eyePosition);
#endif
#ifdef TEXTURE_STAGES
    s.normal = stagedNormal(s.normal, eyePosition);
#endif
    gl_MaterialParameters host = hostMaterial();
    s.emission = hostRadiance(host.emission.rgb);
#ifdef ENVLIGHT_EMISSION
    vec3 emission = envlightEmission;
#ifdef EMISSION_MAP
    emission *= mappedEmission();
#endif
    s.emission = emission * emittedScale();
#endif
#ifdef ENVLIGHT_LIGHT
    s.emission = envlightLight;
#ifdef EMISSION_MAP
    s.emission *= mappedEmission();
#endif
#endif
    vec4 material = host.diffuse;
#if defined(ENVLIGHT_COOK_TORRANCE) || defined(ENVLIGHT_STRAUSS)
    material.rgb = envlightBaseColor;
#endif
#if defined(ENVLIGHT_LAMBERT) || defined(ENVLIGHT_PHONG)
    material.rgb = envlightDiffuse;
#endif
#ifdef WHITE
    material.rgb = vec3(1.0);
#endif
    vec4 base = surfaceColor(material);
    s.alpha = base.a;
    s.albedo = base.rgb;
#ifdef ENVLIGHT_ROUGH_DIFFUSE
    s.diffuseRoughness = envlightDiffuseRoughness;
#endif
#if defined(ENVLIGHT_CATCHER)
    s.alpha = 1.0;
    s.emission = vec3(0.0);
    s.albedo = vec3(CATCHER_ALBEDO);
    s.roughness = CATCHER_ROUGHNESS;
#elif defined(ENVLIGHT_COOK_TORRANCE)
    vec2 roughMetal = vec2(envlightRoughness, envlightMetalness);
#ifdef METAL_ROUGH_MAP
    roughMetal *= mappedRoughMetal();
#endif
    s.brdf = envlightBrdf;
    s.baseColor = base.rgb;
    s.metalness = roughMetal.y;
    s.albedo = base.rgb * (1.0 - roughMetal.y);
    vec3 dielectric = vec3(DIELECTRIC_F0);
#ifdef ENVLIGHT_DIELECTRIC
    dielectric = envlightDielectric;
#endif
    s.f0 = mix(dielectric, base.rgb, roughMetal.y);
    s.roughness = roughMetal.x;
#ifdef ENVLIGHT_EDGE
    s.edge = mix(vec3(1.0), envlightEdge, roughMetal.y);
#endif
#ifdef ENVLIGHT_ANISOTROPY
    vec4 anisotropy = surfaceAnisotropy(s.normal, eyePosition);
    s.anisotropy = anisotropy.w;
    s.brushed = anisotropy.xyz;
#endif
#ifdef ENVLIGHT_COAT
    s.coat = Coat(envlightCoat, envlightCoatRoughness);
#ifdef COAT_MAP
    s.coat.strength *= mappedCoat();
#endif
#ifdef COAT_ROUGHNESS_MAP
    s.coat.roughness *= mappedCoatRoughness();
#endif
#ifdef COAT_NORMAL_MAP
    s.coatNormal = mappedCoatNormal(s.coatNormal, eyePosition);
#endif
    s.emission *= 1.0 - s.coat.strength * fresnelSchlick(vec3(DIELECTRIC_F0), -dot(s.coatNormal, s.ray));
#endif
#elif defined(ENVLIGHT_PHONG)
    s.brdf = envlightBrdf;
    s.f0 = envlightSpecular;
    s.roughness = phongRoughness(envlightExponent);
#elif defined(ENVLIGHT_STRAUSS)
    s.brdf = BRDF_STRAUSS;
    s.albedo = base.rgb * straussDiffuse(envlightSmoothness, envlightMetalness);
    s.f0 = mix(vec3(1.0), base.rgb, envlightMetalness);
    s.roughness = phongRoughness(straussExponent(envlightSmoothness));
#elif defined(PAINTED_REFLECTION) && !defined(ENVLIGHT_MATERIAL)
    s.brdf = BRDF_COOK_TORRANCE;
    s.roughness = PAINTED_ROUGHNESS;
#ifdef TEXTURE_ADD
    s.f0 = vec3(DIELECTRIC_F0);  // a highlight on what is there
#else
    s.albedo = vec3(0.0);
    s.f0 = PAINTED_REFLECTANCE * base.rgb;
#endif
#elif defined(UNLIT)
    s.emission = base.rgb * exp2(materialColors == 0 ? emittedStops : 0.0);
    s.albedo = vec3(0.0);
    s.roughness = UNLIT_ROUGHNESS;
#elif defined(PHONG_MATERIAL)
    // Legacy materials reflect more than they receive: both terms are scaled until diffuse + specular <= 1.
    s.brdf = BRDF_BLINN_PHONG;
    s.f0 = hostColor(host.specular.rgb);
    vec3 sum = s.albedo + s.f0;
    float scale = 1.0 / max(1.0, max(sum.r, max(sum.g, sum.b)));
    s.albedo *= scale;
    s.f0 *= scale;
    s.roughness = phongRoughness(host.shininess);
#endif
    return s;
}

#endif
