#version 330 compatibility
// SPDX-License-Identifier: MIT
// The picture, or any intermediate in its place, into the host's own colour and depth.
#pragma import_defines(HAS_SUN_SHADOWS, HAS_OCCLUSION, BACKGROUND, ACCUMULATED, VIEW_TERM, ANTIALIASED, TEMPORAL)

#include "lib/limits.glsl"
#include "pass/display.glsl"
#include "pass/gbuffer.glsl"
#ifdef VIEW_TERM
#include "pass/picture.glsl"
#include "pass/view.glsl"
uniform sampler2D diffuseLightMap;
uniform float sceneRadius;
#elif defined(ANTIALIASED)
#include "lib/antialias.glsl"
uniform sampler2D displayMap;
#ifdef TEMPORAL
#include "pass/history.glsl"
uniform sampler2D placeMap;
#endif
#else
#include "pass/shown.glsl"
#endif
uniform vec2 viewportOrigin;
uniform vec2 hostDepth;  // offset and factor: from the G-buffer's depth to the host's
#if defined(ANTIALIASED) && defined(ACCUMULATED)
uniform float accumulatedShare;  // of the average, whose edges are smooth
#endif

layout(location = 0) out vec4 color;

#ifdef VIEW_TERM
uniform int view;
uniform int sunCount;
uniform vec3 sunDirection[MOST_SUNS];
uniform float sunRadius[MOST_SUNS];

// The map with the lights of the diffuse list: a dot of each one's colour, its area by its flux, the borders of what is
// nearest to each, and the suns that were cut, ringed.
vec3 lightsView(vec3 d, float pixel)
{
    vec3 c = 0.3 * textureLod(latlongMap, latlongFromDirection(d), 0.0).rgb * radianceScale;
    ivec2 size = textureSize(diffuseLightMap, 0);
    float nearest = 4.0;
    float second = 4.0;
    vec3 flux = vec3(0.0);
    float brightest = 0.0;
    for (int row = 0; row < size.y; row += 2)
        for (int i = 0; i < size.x; ++i) {
            vec3 f = texelFetch(diffuseLightMap, ivec2(i, row + 1), 0).rgb;
            vec3 to = texelFetch(diffuseLightMap, ivec2(i, row), 0).xyz - d;
            float chord2 = dot(to, to);
            brightest = max(brightest, f.r + f.g + f.b);
            second = min(second, max(nearest, chord2));
            if (chord2 < nearest) flux = f;
            nearest = min(nearest, chord2);
        }
    float radius = max(0.03 * sqrt((flux.r + flux.g + flux.b) / max(brightest, 1e-20)), 2.0 * pixel);
    if (sqrt(second) - sqrt(nearest) < 1.5 * pixel) c = vec3(0.15, 0.4, 0.15);
    if (sqrt(nearest) < radius + 1.5 * pixel) c = vec3(0.0);
    if (sqrt(nearest) < radius) c = flux / max(max(flux.r, max(flux.g, flux.b)), 1e-20);
    for (int i = 0; i < sunCount; ++i) {
        float ring = length(sunDirection[i] - d) - max(sunRadius[i], 0.02);
        if (abs(ring) < 1.5 * pixel) c = vec3(1.0, 0.1, 0.8);
    }
    return c;
}

vec3 termView(ivec2 p, vec3 d, float pixel)
{
    if (view == VIEW_DIFFUSE) return diffuseTerm(p) + sunDiffuse(p);
    if (view == VIEW_SPECULAR) return specularTerm(p);
    if (view == VIEW_OCCLUSION) return diffuseTerm(p) - occludedDiffuse(p) + sunDiffuse(p) - sunShaded(p);
    if (view == VIEW_ALBEDO) return pixelAlbedo(p);
    if (view == VIEW_NORMAL) return 0.5 * (mapFromEye * pixelNormal(p)) + 0.5;
    if (view == VIEW_DEPTH) return vec3(-pixelEye(p).z / (4.0 * sceneRadius));
    if (view == VIEW_EMISSION) return emitted(p);
#if defined(HAS_OCCLUSION) || defined(HAS_SUN_SHADOWS)
    if (view == VIEW_VISIBILITY) {
        vec3 all = diffuseTerm(p) + sunDiffuse(p);
        vec3 seen = (occludedDiffuse(p) + sunShaded(p)) / max(all, vec3(1e-20));
        return mix(vec3(1.0), seen, greaterThan(all, vec3(0.0)));  // of nothing nothing is hidden
    }
#endif
    if (view == VIEW_BOUNCE) return bounce(p);
    if (view == VIEW_LIGHTS) return lightsView(d, pixel);
    return vec3(1.0);
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy - viewportOrigin);
    float depth = texelFetch(depthMap, p, 0).r;
    gl_FragDepth = hostDepth.x + hostDepth.y * depth;
#ifdef VIEW_TERM
    vec3 d = mapFromEye * viewRay(inverseProjection, pixelNdc(p));
    float pixel = length(dFdx(d));
    if (depth >= 1.0)
        color = vec4(view == VIEW_LIGHTS ? display(lightsView(d, pixel), 0.0, p) : vec3(0.0), 0.0);
    else
        color = vec4(display(termView(p, d, pixel), 0.0, p), 1.0);
#elif defined(ANTIALIASED)
    EdgeShift shift = edgeShift(displayMap, p);
#ifdef ACCUMULATED
    shift.share *= 1.0 - accumulatedShare;
#elif defined(TEMPORAL)
    shift.share /= float(placeAge(texelFetch(placeMap, p, 0).r));  // edges are smooth where frames were averaged
#endif
#ifndef BACKGROUND
    if (depth >= 1.0 && shift.share <= 0.0) discard;
#endif
    color = texelFetch(displayMap, p, 0);
    if (shift.share > 0.0) color = mix(color, texelFetch(displayMap, p + shift.side, 0), shift.share);
    color.rgb = dithered(color.rgb, p);
#else
#ifndef BACKGROUND
    if (depth >= 1.0) discard;
#endif
    vec4 picture = shownPicture(p);
    color = vec4(display(picture.rgb, shownStops(p), p), picture.a);
#endif
}
