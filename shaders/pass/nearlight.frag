#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces close to a pixel send to it, first part: one ray a pixel, in another of 16 directions at each pixel of a 4x4 cell. The
// colour is the radiance that a white surface would send on, in units of the map's mean. Alpha is the share of directions, by the cosine,
// that these surfaces fill.
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

const float LEAST_HIDDEN = 0.02;  // share of directions in which a pixel does not see the map; below it no ray is worth its time

// The lobe of what reflects more sends too much of its light elsewhere than to the eye.
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

// What its Lambert layer sends.
vec3 sentRadiance(ivec2 q)
{
    vec3 reflectance = pixelAlbedo(q) * texelFetch(diffuseTermMap, q, 0).a;
    vec3 sent = sunShaded(q) + occludedDiffuse(q) + radianceScale * reflectance * texelFetch(probeLightMap, q, 0).rgb;
#ifdef HAS_LAMPS
    if (isAreaLight(emissionMap, q)) return sent;  // what area lights send is a term of its own
#endif
    return emitted(q) + sent;
}

// What is met, as the picture shows it. Where it does not, surfaces have the light of their cells, which are wider than what is near.
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
    // Also towards the eye: there is no other surface, where in a corner one touches the pixel's own.
    eye += (footprint + length(depthStep(inverseProjection, ndc, depth))) * (n - viewRay(inverseProjection, ndc));
    mat3 turn = mat3(atlasFromEye);
    // In the world: the directions do not turn with the view.
    vec3 along = frameAround(turn * n) * phongSample(1.0, cellPoint(0, float(bayer4(p.x, p.y)), 1) + vec2(1.0 / 32.0));
    vec3 origin = vec3(atlasFromEye * vec4(eye, 1.0));
    // Normals that were smoothed over edges lean: a ray may begin behind the plane of its own surface.
    bool looks = dot(along, turn * facet) > 0.0 && 1.0 - ambientVisibility(p) > LEAST_HIDDEN;
    float within = looks ? bounceNearDistance * probeSpacing : 0.0;
    SceneHit met = sceneHit(rayNodeMap, rayTriangleMap, origin, along, within);
    near = vec4(0.0);
    if (!looks || met.distance == MISSED) return;
    // The probes take over gradually.
    float share = 1.0 - smoothstep(0.5, 1.0, met.distance / within);
    near = share * radianceOf(met, eye + met.distance * (along * turn), origin + met.distance * along);
    near.rgb /= radianceScale;
}
