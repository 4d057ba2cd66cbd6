#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces reflect of the area lights, added to the emission: so everything that reads that has it. Irradiance is exact, in closed
// form, times the share that the surface sees [area-lights.md 0]. What lobes reflect is by linearly transformed cosines, of all lobes
// as of GGX's of the same roughness. Where there are many lights, near ones have closed forms, and clusters stand for the others; or
// points that have shadow maps stand for all.
#pragma import_defines(HAS_AREA_SHADOWS, HAS_AREA_POINTS, HAS_LIGHT_CUTS, HAS_DIFFUSE, HAS_LOBES, HAS_AREA_PICTURES)

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
#ifdef HAS_LIGHT_CUTS
#include "pass/lightcuts.glsl"
#endif

uniform mat4 atlasFromEye;
#ifdef HAS_AREA_SHADOWS
uniform sampler2D areaVisibilityMap;  // of the diffuse layer; alpha: of the lobe
#endif
#ifdef HAS_LIGHT_CUTS
uniform sampler2D lightTotalMap;  // of pass/lighttotals.frag
#endif

#ifdef HAS_LOBES
uniform sampler2D ltcTable;
#endif

layout(location = 0) out vec4 added;

// Half of the largest half float, as in pass/scenelights.frag.
const float MOST = 32752.0;

// What reflects light: a lobe, or the diffuse layer.
struct Receiver {
    vec3 point;  // in the world, as all lights
    vec3 n;
    mat3 frame;  // of the lobe, about n
    float alpha;
};

// What a light whose side faces the receiver sends into its lobe, over what a light that is everywhere does.
#ifdef HAS_LOBES
vec3 intoLobe(AreaLight light, Receiver r, Ltc lobe)
{
    bool narrow = FAR_LIGHT * FAR_LIGHT * light.squareRadius < r.alpha * r.alpha * dot(light.center, light.center);  // beside the lobe
    bool far = narrow && isFarLight(light.center, light.squareRadius, r.n);
    AreaLight local = inFrame(light, r.frame);
    float share = far ? ltcDensity(lobe, normalize(light.center) * r.frame) * farSolidAngle(light) : areaShare(local, lobe, r.frame);
    vec3 sum = light.radiance * share;
#ifdef HAS_AREA_PICTURES
    if (light.picture >= 0 && !far) sum *= shownThrough(local, lobe);
#endif
    return sum;
}
#endif

// Irradiance over pi by such a light.
vec3 received(AreaLight light, Receiver r)
{
    bool far = isFarLight(light.center, light.squareRadius, r.n);
    AreaLight local = inFrame(light, r.frame);
    float form = far ? INV_PI * dot(r.n, normalize(light.center)) * farSolidAngle(light) : areaFormFactor(local, r.frame);
    vec3 sum = light.radiance * form;
#if defined(HAS_AREA_PICTURES) && !defined(HAS_AREA_SHADOWS)
    if (light.picture >= 0 && !far) sum *= shownThrough(local, cosineLobe());
#endif
    return sum;
}

#ifdef HAS_LIGHT_CUTS
// The light at which a walk has stopped, if its leaf's side faces the receiver.
bool standsBefore(LightWalk w, Receiver r, out AreaLight light)
{
    light = areaLight(w.leaf / 2, r.point);
    return isLitBy(light, r.n) && light.back == (w.leaf % 2 == 1);
}
#endif

#ifdef HAS_LOBES
#ifdef HAS_LIGHT_CUTS
LightReceiver lobeReceiver(Receiver r, Ltc lobe)
{
    mat3 columns = r.frame * mat3(lobe.inverse.x, 0.0, lobe.inverse.y, 0.0, 1.0, 0.0, lobe.inverse.z, 0.0, lobe.inverse.w);
    float determinant = abs(lobe.inverse.x * lobe.inverse.w - lobe.inverse.y * lobe.inverse.z);
    return LightReceiver(r.n, columns[2], columns, INV_PI * determinant / (1.0 - lobe.leak));
}
#endif

// What a lobe of GGX about the unit normal n sends towards v, both in the world, over its albedo.
// seen: the share of the lights that the lobe sees
vec3 throughLobe(vec3 point, vec3 n, vec3 v, float roughness, float seen)
{
#ifdef HAS_AREA_POINTS
    roughness = lightRoughness(roughness);
#endif
    Receiver r = Receiver(point, n, ltcFrame(n, v), roughness * roughness);
    Ltc lobe = ltcOf(ltcTable, roughness, dot(n, v));
    vec3 sum = vec3(0.0);
#if defined(HAS_AREA_POINTS)
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        vec3 to = e.position - point;
        float kernel = emitterKernel(e, to, n);
        if (kernel <= 0.0) continue;
        vec3 l = normalize(to) * r.frame;
        sum += e.power * (PI * kernel / l.z * ltcDensity(lobe, l));
    }
#elif defined(HAS_LIGHT_CUTS)
    LightReceiver receiver = lobeReceiver(r, lobe);
    LightWalk w = walkOn(beginWalk(roughlySent(point, receiver, lightTreeEnd()), false), point, receiver);
    while (w.leaf != NO_LEAF) {
        AreaLight light;
        if (standsBefore(w, r, light)) w = withSent(w, w.leaf, intoLobe(light, r, lobe), vec3(1.0));
        w = walkOn(w, point, receiver);
    }
    return arriving(w, vec3(seen));
#else
    int count = textureSize(areaLightMap, 0).x;
    for (int i = 0; i < count; ++i) {
        AreaLight light = areaLight(i, point);
        if (isLitBy(light, n)) sum += intoLobe(light, r, lobe);
    }
#endif
    return seen * sum;
}

vec3 reflected(ivec2 p, Bsdf b, vec3 point, vec3 n, vec3 v, float seen)
{
    vec3 sum = vec3(0.0);
    if (b.brdf != BRDF_LAMBERT) sum = b.reflected * throughLobe(point, n, v, evenRoughness(b), seen);
#ifdef HAS_COATS
    if (isCoated(p)) {
        PixelCoat coat = pixelCoat(p);
        sum += coat.bsdf.reflected * throughLobe(point, mat3(atlasFromEye) * coat.normal, v, coat.bsdf.roughness, seen);
    }
#endif
    return sum;
}
#endif

#ifdef HAS_ROUGH_DIFFUSE
ivec2 pixel;
RoughDiffuse layer;
#else
vec3 layer;  // its albedo
#endif

// What the diffuse layer reflects of light from there: as if all of it came from the light's middle.
vec3 diffuseShare(vec3 toLight)
{
#ifdef HAS_ROUGH_DIFFUSE
    return pixelDiffuseBrdf(layer, pixel, pixelNormal(pixel), transpose(mat3(atlasFromEye)) * normalize(toLight));
#else
    return layer;
#endif
}

#ifdef HAS_LIGHT_CUTS
// What it receives, roughly. The pixel that its quad asked may be of a brighter surface: the least of the quads about it.
float lightTotal(ivec2 p)
{
    ivec2 last = textureSize(lightTotalMap, 0) - 1;
    ivec2 beside = ivec2(p.x % 2 == 0 ? -1 : 1, p.y % 2 == 0 ? -1 : 1);
    float least = texelFetch(lightTotalMap, p / 2, 0).r;
    for (int k = 1; k < 4; ++k) {
        ivec2 q = clamp(p / 2 + beside * ivec2(k & 1, k >> 1), ivec2(0), last);
        least = min(least, texelFetch(lightTotalMap, q, 0).r);
    }
    return least;
}
#endif

// What the diffuse layer of that albedo reflects.
// seen: the share of the lights that the surface sees
vec3 diffused(ivec2 p, vec3 albedo, vec3 point, vec3 n, vec3 seen)
{
#ifdef HAS_ROUGH_DIFFUSE
    pixel = p;
    layer = pixelRoughDiffuse(p, albedo);
#else
    layer = albedo;
#endif
    vec3 sum = vec3(0.0);
#ifdef HAS_AREA_POINTS
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        vec3 toLight = e.position - point;
        sum += e.power * emitterKernel(e, toLight, n) * diffuseShare(toLight);
    }
#else
    Receiver r = Receiver(point, n, frameAround(n), 1.0);
#ifdef HAS_LIGHT_CUTS
    LightReceiver receiver = diffuseReceiver(n);
    LightWalk w = walkOn(beginWalk(lightTotal(p), true), point, receiver);
    while (w.leaf != NO_LEAF) {
        AreaLight light;
        if (standsBefore(w, r, light)) w = withSent(w, w.leaf, received(light, r), diffuseShare(light.center));
        w = walkOn(w, point, receiver);
    }
    return arriving(w, seen);
#else
    int count = textureSize(areaLightMap, 0).x;
    for (int i = 0; i < count; ++i) {
        AreaLight light = areaLight(i, point);
        if (isLitBy(light, n)) sum += received(light, r) * diffuseShare(light.center);
    }
#endif
#endif
    return seen * sum;
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
    added.rgb += diffused(p, pixelAlbedo(p) * b.body, point, n, seen.rgb);
#endif
#ifdef HAS_LOBES
    vec3 v = mat3(atlasFromEye) * -viewRay(inverseProjection, pixelNdc(p));
    added.rgb += reflected(p, b, point, n, v, seen.a);
#endif
    added.rgb = min(added.rgb * exp2(-emittedStops), vec3(MOST));  // in the units of the emission's target
}
