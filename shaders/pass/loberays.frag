#version 330 compatibility
#extension GL_ARB_shading_language_packing : require
// SPDX-License-Identifier: MIT
// What the scene does to the lobe of a pixel of a still view, first part. Each frame draws a direction from the lobe and traces a ray. The
// second part lights the surface that the ray meets. Such a surface also hides the map, whose radiance there is L. S holds the share V of
// the map that the first frame saw [pass/lobeshown.glsl]. The ray adds L (1 - V) if it meets nothing, else -L V: the mean corrects S.
#pragma import_defines(HAS_AREA_LIGHTS, MAP_IS_BLACK)
#include "lib/lobesample.glsl"
#include "lib/sharedexponent.glsl"
#include "pass/pixelof.glsl"
#include "pass/pixelray.glsl"
#include "pass/raysurface.glsl"
#include "pass/lightmark.glsl"
#include "pass/lobeshown.glsl"
#include "pass/lobewidth.glsl"
#include "pass/maplight.glsl"
#include "pass/pixelbsdf.glsl"
#include "pass/tracedscene.glsl"

uniform sampler2D diffuseTermMap;
uniform sampler2D emissionMap;
uniform sampler2D specularTermMap;
uniform int specularSamples;
uniform float sceneRadius;
uniform float radianceScale;

// All are over the pixel's reflectance, so that the filter can average pixels of other colours.
layout(location = 0) out vec4 change;    // radiance: of the map, and what is met emits
layout(location = 1) out vec4 place;     // of what is met, about the origin of the triangles; alpha: packSurface(); 0: none
layout(location = 2) out uvec4 surface;  // there: normal, direction of the ray, share of light that the diffuse layer sends on; share of
                                         // the light from there that the lobe passes on

// The lobe of a pixel, or the one of its two that this frame takes.
struct RayLobe {
    vec3 normal;
    mat3 eyeFromLocal;
    vec3 view;
    Bsdf bsdf;
    float chance;    // of being taken
    vec3 shown;      // V
    float lighted;   // share of S that the frame's lights shade
    vec3 reflected;  // by all lobes of the pixel
};

RayLobe rayLobe(ivec2 p)
{
    RayLobe l;
    l.normal = pixelNormal(p);
    l.eyeFromLocal = pixelFrame(p, l.normal);
    l.view = pixelView(p, l.eyeFromLocal);
    l.bsdf = pixelBsdf(p, l.view);
    l.chance = 1.0;
    l.reflected = l.bsdf.reflected;
    l.lighted = lightedShare(texelFetch(normalMap, p, 0).a);
    l.shown = unpackShown(texelFetch(specularTermMap, p, 0).a);
#ifdef HAS_COATS
    if (isCoated(p)) {
        PixelCoat c = pixelCoat(p);
        float below = dot(l.bsdf.reflected, vec3(1.0));
        float above = dot(c.bsdf.reflected, vec3(1.0));
        float share = below > 0.0 ? clamp(above / max(above + below, 1e-20), 0.02, 0.98) : 1.0;
        l.chance = 1.0 - share;
        if (pixelNumber(rayPixel(p), 0x40000000u + uint(sampleFrames)) < share)
            l = RayLobe(c.normal, c.eyeFromLocal, c.view, c.bsdf, share, vec3(1.0), 0.0, l.reflected);
        l.reflected += c.bsdf.reflected;
    }
#endif
    return l;
}

#ifndef MAP_IS_BLACK
vec3 mapLight(Bsdf b, LobeSample s, vec3 d)
{
    if (evenAlpha(b) < MIRROR_ALPHA) return mirror(d);
    return filtered(d, lodOfUnitDensity(float(specularSamples) * sampleFrames) - 0.5 * log2(max(s.density, 1e-10)));
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    change = vec4(0.0);
    place = vec4(0.0);
    surface = uvec4(0u);
    RayLobe l = rayLobe(p);
    LobeSample s = sampleLobe(l.bsdf, l.view, fract(rayPoint(p)));
    if (max(s.weight.r, max(s.weight.g, s.weight.b)) <= 0.0) return;
    vec3 weight = s.weight / (l.chance * max(l.reflected, vec3(1e-4)));
    vec3 origin = rayOrigin(p, l.normal);
    vec3 along = l.eyeFromLocal * s.direction;
    mat3 placesDirection = mat3(placesFromEye);
    vec3 from = vec3(placesFromEye * vec4(origin, 1.0));
    SceneHit met = sceneHit(rayNodeMap, rayTriangleMap, from, placesDirection * along, 4.0 * sceneRadius, STOPS_BY_PLACE);
    bool misses = met.distance == MISSED;
#ifndef MAP_IS_BLACK
    vec3 shown = misses ? 1.0 - l.shown : -l.shown;
    change.rgb = (1.0 - l.lighted) * radianceScale * weight * shown * mapLight(l.bsdf, s, mapFromEye * along);
#endif
    if (misses) return;
    TracedLayers layers = tracedLayers(met.surface);
    vec3 emission = tracedEmission(met);
    vec3 normal = smoothNormal(rayTriangleMap, met);
    // The picture knows more colours of a surface than one.
    ivec2 q = pixelOf(origin + met.distance * along, transpose(placesDirection) * normal);
    if (q.x >= 0) {
        layers.diffuse = pixelAlbedo(q) * texelFetch(diffuseTermMap, q, 0).a;
        emission = texelFetch(emissionMap, q, 0).rgb * exp2(emittedStops);
#ifdef HAS_AREA_LIGHTS
        if (isAreaLight(emissionMap, q)) emission = vec3(0.0);
#endif
    }
    change.rgb += weight * emission;
    place = vec4(from + met.distance * (placesDirection * along), packSurface(met.surface, evenRoughness(l.bsdf)));
    surface = uvec4(packUnorm2x16(octahedralFromDirection(normal)), packUnorm2x16(octahedralFromDirection(placesDirection * along)),
                    packSharedExponent(layers.diffuse), packSharedExponent(weight));
}
