#version 330 compatibility
// SPDX-License-Identifier: MIT
// What other surfaces send to a pixel of a still view: rays in directions that a Lambert surface weighs alike, and what they meet
// [final gathering: Reichert 1992; Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, 8.4]. Each frame takes other
// directions. What is met is lit by this frame's lights, and by the probes for what it receives from further surfaces.
#pragma import_defines(MAP_IS_BLACK)
#include "lib/frame.glsl"
#include "lib/phong.glsl"
#include "lib/sequence.glsl"
#include "pass/atlas.glsl"
#include "pass/gbuffer.glsl"
#include "pass/probegrid.glsl"
#include "pass/tracedscene.glsl"
#include "pass/receivedlight.glsl"

uniform mat4 placesFromEye;  // to the origin of the triangles, of which places are told
uniform vec3 placesInAtlas;
uniform float sceneRadius;
uniform vec2 sampleShift;  // of this frame
uniform float sampleFrames;  // its number
uniform int accumulateRays;

// Radiance that a white surface would send on.
layout(location = 0) out vec4 rayLight;

// The frame's lights light so many surfaces along a path. The probes, into which light leaks, stand for all surfaces behind them. A room
// with a slot for a window after 64 frames, beside full light transport: 16.1, 11.6, 9.5 % with 1, 2, 3; 26.1 % by probes alone.
const int PATH_SURFACES = 3;
// From a ray to the next of a frame: 65536 points of the R2 sequence further on, where the frames do not come.
const vec2 NEXT_RAY = vec2(0.0533108, 0.6627351);
const float LEAVE = 1e-4;  // distance from a surface at which a ray begins there, in radii of the scene

float sentShare(vec3 l, vec3 place, vec3 n)
{
    return 0.0;
}

// From map, suns and lamps: suns are among the frame's lights. isLast: also from other surfaces.
vec3 lightAt(vec3 place, vec3 n, bool isLast)
{
    ReceivedLight sum = ReceivedLight(vec3(0.0), vec3(0.0));
    float all = 0.0;
    float seen = 0.0;
    int lights = textureSize(atlasLightMap, 0).x * LIGHT_GROUPS;
    for (int i = 0; i < lights; ++i) {
        AtlasLight l = atlasLight(i % LIGHT_GROUPS, i / LIGHT_GROUPS);
        float c = dot(n, l.direction);
        if (c <= 0.0) continue;
        float sees = atlasSees(l, place + placesInAtlas, n, c);
        all += c * l.solidAngle;
        seen += sees * c * l.solidAngle;
#ifndef MAP_IS_BLACK
        receive(sees * c * INV_PI * l.flux, l.direction, place, n, sum);
#endif
    }
#ifdef HAS_AREA_LIGHTS
    receiveAreaLights(place, n, sum);
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
    receiveSceneLights(place, n, sum);
#endif
    if (isLast) sum.all += receivedFrom(sentAbout(probesAbout(place, n, n), n), all > 0.0 ? 1.0 - seen / all : 0.0);
    return sum.all;
}

// Radiance that comes along a path, in units of the map's mean. pixel, ray: numbers that no other ray has.
vec3 pathLight(vec3 origin, vec3 along, uint pixel, uint ray)
{
    vec3 sum = vec3(0.0);
    vec3 reflected = vec3(1.0);
    for (int i = 0; i < PATH_SURFACES; ++i) {
        SceneHit met = sceneHit(rayNodeMap, rayTriangleMap, origin, along, 4.0 * sceneRadius);
        if (met.distance == MISSED) break;
        vec3 n = normalize(met.normal);
        vec3 place = origin + met.distance * along;
        sum += reflected * tracedEmission(met) / radianceScale;
        reflected *= tracedReflectance(met);
        sum += reflected * lightAt(place, n, i + 1 == PATH_SURFACES);
        uint number = 2u * (uint(PATH_SURFACES) * ray + uint(i));
        along = frameAround(n) * phongSample(1.0, vec2(pixelNumber(pixel, number), pixelNumber(pixel, number + 1u)));
        origin = place + LEAVE * sceneRadius * n;
    }
    return sum;
}

// The 16 pixels of a cell share one set of directions; each cell has another one.
vec2 cellDirection(ivec2 p)
{
    uint cell = uint(p.x / 4) + 65536u * uint(p.y / 4);
    return cellPoint(0, float(bayer4(p.x, p.y)), 1) + vec2(pixelNumber(cell, 0u), pixelNumber(cell, 1u));
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 n = pixelNormal(p);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    float lift = pixelFootprint(inverseProjection, ndc, depth, viewportSize) + length(depthStep(inverseProjection, ndc, depth));
    vec3 origin = vec3(placesFromEye * vec4(eyeFromDepth(inverseProjection, ndc, depth) + lift * n, 1.0));
    mat3 placesFromLocal = mat3(placesFromEye) * frameAround(n);
    vec2 first = sampleShift + cellDirection(p);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < accumulateRays; ++k) {
        vec3 along = placesFromLocal * phongSample(1.0, fract(first + float(k) * NEXT_RAY));
        sum += pathLight(origin, along, uint(p.x) + 65536u * uint(p.y), uint(sampleFrames) * uint(accumulateRays) + uint(k));
    }
    rayLight = vec4(radianceScale * sum / float(accumulateRays), 1.0);
}
