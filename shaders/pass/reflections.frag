#version 330 compatibility
// SPDX-License-Identifier: MIT
// What glossy surfaces show of the picture, first part: one ray a pixel [indirect2.md 3, 6]. A narrow lobe's ray goes in the mirror
// direction; in wider lobes each pixel of a 4x4 cell takes another direction. Rays read this frame's picture, in which the lobes
// still show the mean radiance of what blocks light. No earlier frame is read, so nothing trails behind what moves. Where the picture does
// not show what a ray meets, the scene's triangles do.
#pragma import_defines(HAS_AREA_LIGHTS, HAS_SCENE_RAYS, RAYS_MEET_ALL)
#include "lib/lobesample.glsl"
#include "lib/march.glsl"
#include "lib/sequence.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightmark.glsl"
#include "pass/lobewidth.glsl"
#include "pass/toplobe.glsl"

uniform sampler2D radianceMap;
#ifdef HAS_AREA_LIGHTS
uniform sampler2D emissionMap;
#endif
#ifdef HAS_SCENE_RAYS
#include "pass/scenecells.glsl"
uniform mat4 atlasFromEye;  // to the origin of the triangles
uniform float probeShare;   // of what surface points know, in the picture
#include "pass/toplight.glsl"
#endif
uniform float sceneRadius;
uniform int reflectionSteps;

// Radiance of what is met, times whether it is; whether. That is below 0 where a narrow lobe's ray is known to meet nothing.
layout(location = 0) out vec4 reflection;

// Each of a cell's 16 rays stands for a cone. A cone that holds a sixteenth of the lobe is made wider by this factor. Metal balls at
// roughness .2 and .3 under studio, beside full light transport: tRMSE 7.57 and 5.98 % with 0, 7.50 and 5.90 % with 1.5.
const float CONE_WIDTH = 1.5;
const float HIT_TOLERANCE = 0.5;  // distance from a surface's plane at which a ray still hits it, in widths of a pixel

// A direction of the lobe in its local frame; below the horizon it meets nothing.
vec3 lobeDirection(Bsdf b, vec3 v, int group)
{
    if (evenRoughness(b) < NARROW_ROUGHNESS) return vec3(-v.x, -v.y, v.z);
    return sampleLobe(b, v, cellPoint(0, float(group), 1) + vec2(1.0 / 32.0)).direction;
}

// What a pixel of the picture sends. What lobes reflect of an area light is known, whether the picture shows the light or not.
vec3 sentRadiance(ivec2 p)
{
#ifdef HAS_AREA_LIGHTS
    if (isAreaLight(emissionMap, p)) return vec3(0.0);
#endif
    return texelFetch(radianceMap, p, 0).rgb;
}

// Mean of the picture over the cone about a ray that meets a surface. It takes the pixel and, of 8 points of a spiral about it, those that
// lie on the same surface. tangent: of the cone's half-angle.
vec3 coneRadiance(ScreenHit hit, float tangent)
{
    vec3 sum = sentRadiance(hit.pixel);
    vec2 ndc = pixelNdc(hit.pixel);
    float depth = texelFetch(depthMap, hit.pixel, 0).r;
    float radius = tangent * hit.distance / pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    if (radius < 0.5) return sum;
    PixelPlane plane = pixelPlane(eyeFromDepth(inverseProjection, ndc, depth), pixelNormal(hit.pixel), 2.0 * tangent * hit.distance);
    float count = 1.0;
    for (int i = 0; i < 8; ++i) {
        float angle = 2.39996322972865332 * float(i);
        ivec2 q = hit.pixel + ivec2(round(radius * sqrt((float(i) + 1.0) / 8.0) * vec2(cos(angle), sin(angle))));
        q = clamp(q, ivec2(0), ivec2(viewportSize) - 1);
        float w = abs(planeDistance(plane, q, texelFetch(depthMap, q, 0).r)) < 1.0 ? 1.0 : 0.0;
        sum += w * sentRadiance(q);
        count += w;
    }
    return sum / count;
}

#ifdef HAS_SCENE_RAYS
// Share of the pixel's light that changes if the scene hides the map. Below the first value no ray goes through the scene. Above the
// second the ray's answer counts fully.
const vec2 TRACED_SHARE = vec2(0.05, 0.1);

// One ray tells all about a sharp lobe. Coats are left out: no pass keeps what the scene takes from them.
bool hasSharpLobe(ivec2 p, Bsdf b)
{
#ifdef HAS_COATS
    if (isCoated(p)) return false;
#endif
    return evenRoughness(b) < NARROW_ROUGHNESS;
}

// How much the answer of a ray through the scene counts. Strong lobes need it. A weak lobe needs it if the map's reflection is much of
// the light of a dark pixel.
float tracedShare(ivec2 p, Bsdf b)
{
    TopLight light = topLight(p);
    float hidden = light.blocked.w;
    if (hidden > 0.0 && hasSharpLobe(p, b)) hidden = 1.0;  // the scene hides all of it or nothing; lights nearby do not tell which
    float mirrored = radianceScale * dot(light.specular, vec3(1.0)) / max(dot(texelFetch(radianceMap, p, 0).rgb, vec3(1.0)), 1e-20);
    float reflected = max(b.reflected.r, max(b.reflected.g, b.reflected.b));
    return smoothstep(TRACED_SHARE.x, TRACED_SHARE.y, hidden * max(reflected, min(mirrored, 1.0)));
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    TopLobe lobe = topLobe(p);
    vec3 n = lobe.normal;
    mat3 eyeFromLocal = lobe.eyeFromLocal;
    vec3 v = pixelView(p, eyeFromLocal);
    Bsdf b = lobe.bsdf;
    int group = bayer4(p.x, p.y);
    vec3 d = lobeDirection(b, v, group);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    float footprint = pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    vec3 origin = eyeFromDepth(inverseProjection, ndc, depth) + (footprint + length(depthStep(inverseProjection, ndc, depth))) * n;
    ScreenRay ray = screenRay(projection, inverseProjection, viewportSize, origin, eyeFromLocal * d, 2.0 * sceneRadius,
                              HIT_TOLERANCE * footprint);
    reflection = vec4(0.0);
    if (d.z <= 0.0) return;
    // Points between those of its neighbours, where these are averaged; else as they, so that edges are lines.
    float phase = evenRoughness(b) < NARROW_ROUGHNESS ? 1.0 : (float(group) + 1.0) / 16.0;
    ScreenHit hit = screenRayHit(depthMap, normalMap, ray, reflectionSteps, phase);
    float share = hit.found ? smoothstep(0.0, 0.1, hit.border) : 0.0;  // fades where the picture ends
    float tangent = 0.0;
    if (evenRoughness(b) >= NARROW_ROUGHNESS)
        tangent = CONE_WIDTH * inversesqrt(16.0 * PI * ggxReflectionPdf(v, normalize(v + d), lobeAlpha(b)));
    if (share > 0.0) reflection = share * vec4(coneRadiance(hit, tangent), 1.0);
#ifdef HAS_SCENE_RAYS
    float traced = probeShare * tracedShare(p, b);
    if (share < 1.0 && traced > 0.0) {
        vec3 from = vec3(atlasFromEye * vec4(origin, 1.0));
        vec3 along = mat3(atlasFromEye) * (eyeFromLocal * d);
        SceneHit met = sceneHit(rayNodeMap, rayTriangleMap, from, along, 2.0 * sceneRadius, STOPS_FROM_HALF);
        if (met.distance != MISSED) reflection += (1.0 - share) * traced * sceneRadiance(met, from + met.distance * along);
#ifdef RAYS_MEET_ALL
        else if (share == 0.0 && hasSharpLobe(p, b)) reflection.a = -traced;
#endif
    }
#endif
}
