#version 330 compatibility
// SPDX-License-Identifier: MIT
// First part of the light that surfaces close to a pixel send to it. Each pixel traces one ray. The 16 pixels of a 4x4 cell trace theirs in
// different directions. The colour is the radiance that a white surface would send on, in units of the map's mean. Alpha is the
// cosine-weighted share of directions that these surfaces fill.
#pragma import_defines(HAS_LAMPS)
#include "lib/frame.glsl"
#include "lib/phong.glsl"
#include "lib/sequence.glsl"
#include "pass/pixelof.glsl"
#include "pass/scenecells.glsl"
#include "pass/terms.glsl"
#ifdef HAS_LAMPS
#include "pass/lightmark.glsl"
#endif

uniform sampler2D probeLightMap;  // of pass/indirect.frag
uniform mat4 atlasFromEye;        // to the origin of the triangles
uniform float bounceNearDistance;
uniform float probeSpacing;

layout(location = 0) out vec4 near;

// A pixel that does not see the map in a smaller share of directions traces no ray: the ray would change little.
const float LEAST_HIDDEN = 0.02;
// A lobe that reflects a larger share sends too much of its light elsewhere than to the eye.
const float MOST_GLOSSY = 0.1;

// Whether a pixel sends to all sides what it sends to the eye.
bool sendsEvenly(ivec2 q)
{
    if (pixelBrdf(q) == BRDF_LAMBERT) return true;
#ifdef HAS_LAMPS
    return false;  // what lobes reflect of lamps is in emissionMap
#else
    vec3 f0 = pixelF0(q);
    return max(f0.r, max(f0.g, f0.b)) < MOST_GLOSSY;
#endif
}

// What the Lambert layer of a pixel sends.
vec3 sentRadiance(ivec2 q)
{
    vec3 reflectance = pixelAlbedo(q) * texelFetch(diffuseTermMap, q, 0).a;
    vec3 sent = sunShaded(q) + occludedDiffuse(q) + radianceScale * reflectance * texelFetch(probeLightMap, q, 0).rgb;
#ifdef HAS_LAMPS
    if (isAreaLight(emissionMap, q)) return sent;  // what area lights send is a term of its own
#endif
    return emitted(q) + sent;
}

// The radiance of what a ray meets. The picture knows that of surfaces that it shows. The cells know that of all surfaces, but less
// exactly: a cell is wider than what is near.
vec4 radianceOf(SceneHit met, vec3 eye, vec3 place)
{
    ivec2 q = pixelOf(eye, transpose(mat3(atlasFromEye)) * normalize(met.normal));
    if (q.x >= 0 && sendsEvenly(q)) return vec4(sentRadiance(q), 1.0);
    return sceneRadiance(met, place);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 ndc = pixelNdc(p);
    float depth = texelFetch(depthMap, p, 0).r;
    float footprint = pixelFootprint(inverseProjection, ndc, depth, viewportSize);
    vec3 n = pixelNormal(p);
    vec3 eye = eyeFromDepth(inverseProjection, ndc, depth);
    vec3 facet = pixelFacet(p, eye, n, footprint);
    // The ray begins off the surface, and nearer to the eye. In a corner the point off the surface may lie in the other wall, but nothing
    // lies between the pixel and the eye.
    eye += (footprint + length(depthStep(inverseProjection, ndc, depth))) * (n - viewRay(inverseProjection, ndc));
    mat3 turn = mat3(atlasFromEye);
    // The frame is built in the world, so the directions do not turn with the view.
    vec3 along = frameAround(turn * n) * phongSample(1.0, cellPoint(0, float(bayer4(p.x, p.y)), 1) + vec2(1.0 / 32.0));
    vec3 origin = vec3(atlasFromEye * vec4(eye, 1.0));
    // Normals that were smoothed over edges lean: a ray may begin behind the plane of its own surface.
    bool looks = dot(along, turn * facet) > 0.0 && 1.0 - ambientVisibility(p) > LEAST_HIDDEN;
    float within = looks ? bounceNearDistance * probeSpacing : 0.0;
    SceneHit met = sceneHit(rayNodeMap, rayTriangleMap, origin, along, within, STOPS_BY_PLACE);
    near = vec4(0.0);
    if (!looks || met.distance == MISSED) return;
    // The probes take over gradually.
    float share = 1.0 - smoothstep(0.5, 1.0, met.distance / within);
    near = share * radianceOf(met, eye + met.distance * (along * turn), origin + met.distance * along);
    near.rgb /= radianceScale;
}
