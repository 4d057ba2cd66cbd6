#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces reflect of the area lights, added to the emission: so everything that reads that has it. Irradiance is exact, in closed
// form, times the share that the surface sees [area-lights.md 0]. What lobes reflect is by linearly transformed cosines, of all lobes
// as of GGX's of the same roughness.
#pragma import_defines(HAS_AREA_SHADOWS, HAS_AREA_POINTS, HAS_DIFFUSE, HAS_LOBES, HAS_AREA_PICTURES)

#include "lib/scenelight.glsl"
#include "pass/arealights.glsl"
#ifdef HAS_AREA_POINTS
#include "lib/atlas.glsl"
#include "pass/emitterpoints.glsl"
#endif
#ifdef HAS_AREA_PICTURES
#include "pass/areapictures.glsl"
#endif
#include "pass/gbuffer.glsl"
#include "pass/hostcolor.glsl"
#include "pass/pixelbsdf.glsl"

uniform mat4 atlasFromEye;
#ifdef HAS_AREA_SHADOWS
uniform sampler2D areaVisibilityMap;  // of the diffuse layer; alpha: of the lobe
#endif

#ifdef HAS_LOBES
uniform sampler2D ltcTable;
#endif

layout(location = 0) out vec4 added;

// Half of the largest half float, as in pass/scenelights.frag.
const float MOST = 32752.0;

#ifdef HAS_LOBES
// What a lobe of GGX about the unit normal n sends towards v, both in the world, over its albedo.
vec3 throughLobe(vec3 point, vec3 n, vec3 v, float roughness)
{
    mat3 frame = ltcFrame(n, v);
#ifdef HAS_AREA_POINTS
    roughness = lightRoughness(roughness);
#endif
    Ltc lobe = ltcOf(ltcTable, roughness, dot(n, v));
    vec3 sum = vec3(0.0);
#ifdef HAS_AREA_POINTS
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        vec3 to = e.position - point;
        float kernel = emitterKernel(e, to, n);
        if (kernel <= 0.0) continue;
        vec3 l = normalize(to) * frame;
        sum += e.power * (PI * kernel / l.z * ltcDensity(lobe, l));
    }
#else
    float alpha = roughness * roughness;
    int count = textureSize(areaLightMap, 0).x;
    for (int i = 0; i < count; ++i) {
        AreaLight light = areaLight(i, point);
        if (!isLitBy(light, n)) continue;
        bool far = isFarLight(light, n) && AREA_FAR * AREA_FAR * light.squareRadius < alpha * alpha * dot(light.center, light.center);
        vec3 l = normalize(light.center) * frame;
        AreaLight local = inFrame(light, frame);
        float share = far ? ltcDensity(lobe, l) * farSolidAngle(light) : areaShare(local, lobe, frame);
        vec3 radiance = light.radiance;
#ifdef HAS_AREA_PICTURES
        if (light.picture >= 0 && !far) radiance *= shownThrough(local, lobe);
#endif
        sum += radiance * share;
    }
#endif
    return sum;
}

vec3 reflected(ivec2 p, Bsdf b, vec3 point, vec3 n, vec3 v)
{
    vec3 sum = vec3(0.0);
    if (b.brdf != BRDF_LAMBERT) sum = b.reflected * throughLobe(point, n, v, evenRoughness(b));
#ifdef HAS_COATS
    if (isCoated(p)) {
        PixelCoat coat = pixelCoat(p);
        sum += coat.bsdf.reflected * throughLobe(point, mat3(atlasFromEye) * coat.normal, v, coat.bsdf.roughness);
    }
#endif
    return sum;
}
#endif

// What the diffuse layer of that albedo reflects.
vec3 diffused(ivec2 p, vec3 albedo, vec3 point, vec3 n)
{
#ifdef HAS_ROUGH_DIFFUSE
    RoughDiffuse layer = pixelRoughDiffuse(p, albedo);
#endif
    vec3 sum = vec3(0.0);
#ifdef HAS_AREA_POINTS
    int count = textureSize(emitterPointMap, 0).x;
#else
    int count = textureSize(areaLightMap, 0).x;
    mat3 frame = frameAround(n);
#endif
    for (int i = 0; i < count; ++i) {
#ifdef HAS_AREA_POINTS
        EmitterPoint e = emitterPoint(i);
        vec3 toLight = e.position - point;
        vec3 received = e.power * emitterKernel(e, toLight, n);
#else
        AreaLight light = areaLight(i, point);
        if (!isLitBy(light, n)) continue;
        vec3 toLight = light.center;
        bool far = isFarLight(light, n);
        AreaLight local = inFrame(light, frame);
        float form = far ? INV_PI * dot(n, normalize(toLight)) * farSolidAngle(light) : areaFormFactor(local, frame);
        vec3 received = light.radiance * form;
#if defined(HAS_AREA_PICTURES) && !defined(HAS_AREA_SHADOWS)
        if (light.picture >= 0 && !far) received *= shownThrough(local, cosineLobe());
#endif
#endif
#ifdef HAS_ROUGH_DIFFUSE
        // As if all of the light came from its middle.
        sum += received * pixelDiffuseBrdf(layer, p, pixelNormal(p), transpose(mat3(atlasFromEye)) * normalize(toLight));
#else
        sum += received * albedo;
#endif
    }
    return sum;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 eyeNormal = pixelNormal(p);
    vec3 n = mat3(atlasFromEye) * eyeNormal;
    vec3 point = vec3(atlasFromEye * vec4(pixelEye(p), 1.0));
    vec4 seen = vec4(1.0);
#ifdef HAS_AREA_SHADOWS
    seen = texelFetch(areaVisibilityMap, p, 0);
#endif
    Bsdf b = pixelBsdf(p, lobeView(p, eyeNormal));
    added = vec4(0.0);
#ifdef HAS_DIFFUSE
    added.rgb += seen.rgb * diffused(p, pixelAlbedo(p) * b.body, point, n);
#endif
#ifdef HAS_LOBES
    vec3 v = mat3(atlasFromEye) * -viewRay(inverseProjection, pixelNdc(p));
    added.rgb += seen.a * reflected(p, b, point, n, v);
#endif
    added.rgb = min(added.rgb * exp2(-emittedStops), vec3(MOST));  // in the units of the emission's target
}
