// SPDX-License-Identifier: MIT
// Reading the G-buffer in a full-screen pass.
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL
#pragma import_defines(HAS_COATS, HAS_ANISOTROPY, HAS_EDGES, HAS_ROUGH_DIFFUSE)

#include "lib/anisotropy.glsl"
#include "lib/brdfs.glsl"
#include "lib/depth.glsl"
#include "lib/frame.glsl"
#include "lib/fresnel.glsl"
#include "lib/octahedral.glsl"
#include "lib/roughdiffuse.glsl"

uniform sampler2D albedoMap;
uniform sampler2D normalMap;
uniform sampler2D specularMap;
uniform sampler2D depthMap;

uniform mat4 projection;
uniform mat4 inverseProjection;
uniform mat3 mapFromEye;     // rotates eye directions into the environment map's frame
uniform vec2 viewportSize;

bool isBackground(ivec2 p)
{
    return texelFetch(depthMap, p, 0).r >= 1.0;
}

vec2 pixelNdc(ivec2 p)
{
    return (vec2(p) + 0.5) / viewportSize * 2.0 - 1.0;
}

// Angle between the view rays of two pixels side by side.
float pixelTurn(vec2 ndc)
{
    return length(viewRay(inverseProjection, ndc + vec2(0.0, 2.0 / viewportSize.y)) - viewRay(inverseProjection, ndc));
}

vec3 pixelEye(ivec2 p)
{
    return eyeFromDepth(inverseProjection, pixelNdc(p), texelFetch(depthMap, p, 0).r);
}

vec3 pixelNormal(ivec2 p)
{
    return normalize(texelFetch(normalMap, p, 0).xyz * 2.0 - 1.0);
}

float depthOrNone(ivec2 p)
{
    bool outside = min(p.x, p.y) < 0 || float(p.x) >= viewportSize.x || float(p.y) >= viewportSize.y;
    return outside ? 2.0 : texelFetch(depthMap, p, 0).r;
}

// Normal of the plane about a pixel at eye with normal n: that of its depths where the pixel's own, which may be interpolated
// over facets, does not fit them; n where they are of no plane.
vec3 pixelFacet(ivec2 p, vec3 eye, vec3 n, float footprint)
{
    float d = texelFetch(depthMap, p, 0).r;
    vec2 ndc = pixelNdc(p);
    vec2 stride = 2.0 / viewportSize;
    ivec2 x = ivec2(1, 0);
    ivec2 y = ivec2(0, 1);
    vec2 dx = depthSlope(depthOrNone(p - 2 * x), depthOrNone(p - x), d, depthOrNone(p + x), depthOrNone(p + 2 * x));
    vec2 dy = depthSlope(depthOrNone(p - 2 * y), depthOrNone(p - y), d, depthOrNone(p + y), depthOrNone(p + 2 * y));
    vec3 across = eyeFromDepth(inverseProjection, ndc + vec2(stride.x, 0.0), d + dx.x) - eye;
    vec3 up = eyeFromDepth(inverseProjection, ndc + vec2(0.0, stride.y), d + dy.x) - eye;
    float quantum = length(depthStep(inverseProjection, ndc, d));
    if (max(abs(dot(n, across)), abs(dot(n, up))) <= 0.05 * footprint + 2.0 * quantum) return n;
    float bend = length(eyeFromDepth(inverseProjection, ndc, d - max(dx.y, dy.y)) - eye);
    vec3 facet = cross(across, up);
    // Normals that were smoothed over a box's corner lean by 55 degrees. A facet further from the normal mixes two surfaces.
    return bend <= 0.5 * footprint && dot(facet, n) > 0.5 * length(facet) ? normalize(facet) : n;
}

vec3 pixelFacet(ivec2 p, vec3 eye, vec3 n)
{
    float depth = texelFetch(depthMap, p, 0).r;
    return pixelFacet(p, eye, n, pixelFootprint(inverseProjection, pixelNdc(p), depth, viewportSize));
}

// A plane in eye space, to be asked about pixels by their depths: distance from it in units, times w of the point, and that w.
struct PixelPlane {
    vec4 distance;
    vec4 w;
};

PixelPlane pixelPlane(vec3 point, vec3 normal, float unit)
{
    PixelPlane plane;
    plane.distance = vec4(normal, -dot(normal, point)) / unit * inverseProjection;
    plane.w = vec4(0.0, 0.0, 0.0, 1.0) * inverseProjection;
    return plane;
}

// Of the surface in a pixel.
float planeDistance(PixelPlane plane, ivec2 p, float depth)
{
    vec4 q = vec4(pixelNdc(p), 2.0 * depth - 1.0, 1.0);
    return dot(plane.distance, q) / dot(plane.w, q);
}

// Unit vector to the eye, in a frame about the pixel's normal.
vec3 pixelView(ivec2 p, mat3 eyeFromLocal)
{
    vec3 v = transpose(eyeFromLocal) * -viewRay(inverseProjection, pixelNdc(p));
    v.z = max(v.z, 1e-4); // interpolated normals may lean away from the eye
    return normalize(v);
}

// Number of the BRDF, with the parameters of a coat, of anisotropy, of a metal's edge or of the diffuse layer [packKind()].
uint pixelKind(ivec2 p)
{
    return uint(texelFetch(specularMap, p, 0).a * 65535.0 + 0.5);
}

bool isShadowCatcher(ivec2 p)
{
    return isCatcher(kindBrdf(pixelKind(p)), texelFetch(normalMap, p, 0).a);
}

#ifdef HAS_COATS
bool isCoated(ivec2 p)
{
    return kindBrdf(pixelKind(p)) == BRDF_COATED;
}

vec3 pixelCoatNormal(ivec2 p)
{
    return directionFromOctahedral(texelFetch(specularMap, p, 0).gb);
}
#endif

// Of a coated surface what is below the coat.
int pixelBrdf(ivec2 p)
{
    int brdf = kindBrdf(pixelKind(p));
#ifdef HAS_COATS
    if (brdf == BRDF_COATED) return BRDF_COOK_TORRANCE;
#endif
#ifdef HAS_ANISOTROPY
    if (brdf == BRDF_ANISOTROPIC) return BRDF_COOK_TORRANCE;
#endif
    return brdf;
}

#ifdef HAS_ANISOTROPY
Anisotropy pixelAnisotropy(ivec2 p)
{
    uint kind = pixelKind(p);
    return unpackAnisotropy(kindBrdf(kind) == BRDF_ANISOTROPIC ? kindParameters(kind) : 0u);
}
#endif

#ifdef HAS_EDGES
// What is left of Schlick's reflectance towards grazing angles.
vec3 pixelEdge(ivec2 p)
{
    uint kind = pixelKind(p);
    int brdf = kindBrdf(kind);
    return unpackEdge(brdf == BRDF_COOK_TORRANCE || brdf == BRDF_BECKMANN ? kindParameters(kind) : 0u);
}
#endif

#ifdef HAS_ROUGH_DIFFUSE
// The diffuse layer, which reflects that albedo.
RoughDiffuse pixelRoughDiffuse(ivec2 p, vec3 albedo)
{
    uint kind = pixelKind(p);
    int brdf = kindBrdf(kind);
    bool other = brdf == BRDF_COATED || brdf == BRDF_ANISOTROPIC;
    return roughDiffuse(albedo, other ? 0.0 : unpackDiffuseRoughness(kindParameters(kind)));
}

// Towards the eye, for light from the direction l in eye space: pi times the BRDF.
vec3 pixelDiffuseBrdf(RoughDiffuse d, ivec2 p, vec3 n, vec3 l)
{
    vec3 v = -viewRay(inverseProjection, pixelNdc(p));
    return roughDiffuseBrdf(d, max(dot(n, v), 0.0), max(dot(n, l), 0.0), dot(v, l));
}
#endif

// The frame of the pixel's lobe about its normal n, in eye space.
mat3 pixelFrame(ivec2 p, vec3 n)
{
    mat3 frame = frameAround(n);
#ifdef HAS_ANISOTROPY
    Anisotropy a = pixelAnisotropy(p);
    if (a.strength > 0.0) frame = turnedFrame(frame, a.angle);
#endif
    return frame;
}

vec3 pixelAlbedo(ivec2 p)
{
    vec3 albedo = texelFetch(albedoMap, p, 0).rgb;
#ifdef HAS_COATS
    if (isCoated(p)) albedo *= 1.0 - texelFetch(specularMap, p, 0).r;
#endif
    return albedo;
}

// Reflectance of the lobe at normal incidence.
vec3 pixelF0(ivec2 p)
{
    vec3 f0 = texelFetch(specularMap, p, 0).rgb;
#ifdef HAS_COATS
    if (isCoated(p)) return mix(vec3(DIELECTRIC_F0), texelFetch(albedoMap, p, 0).rgb, f0.r);
#endif
    return f0;
}

#endif
