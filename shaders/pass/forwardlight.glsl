// SPDX-License-Identifier: MIT
// Light on surfaces that no G-buffer holds: the same environment functions, one look-up for the lobe in place of the importance
// samples. Shadow maps say what hides the light; eight points of each sun's disc are looked up.
#ifndef FORWARDLIGHT_GLSL
#define FORWARDLIGHT_GLSL
#pragma import_defines(FOGGED, HAS_COATS, HAS_ANISOTROPY, HAS_EDGES, HAS_ROUGH_DIFFUSE, HAS_SPECULAR, HAS_SUNS, SUN_DIFFUSE, HAS_ATLAS, HAS_SUN_MAPS, HAS_BOUNCE, HAS_PROBES, HAS_SCENE_LIGHTS, HAS_SCENE_LIGHT_MAPS, HAS_AREA_LIGHTS)

#include "lib/atlas.glsl"
#include "lib/frame.glsl"
#include "lib/limits.glsl"
#include "lib/octahedral.glsl"
#include "lib/roughdiffuse.glsl"
#include "lib/scenelight.glsl"
#include "lib/sequence.glsl"
#include "lib/tone.glsl"
#include "pass/albedo.glsl"
#include "pass/hostcolor.glsl"
#include "pass/irradiance.glsl"
#include "pass/litsurface.glsl"
#include "pass/skyseen.glsl"
#if defined(HAS_SUNS) || defined(HAS_SUN_MAPS)
#include "lib/glint.glsl"
#include "pass/suns.glsl"
#endif
#ifdef HAS_SUN_MAPS
#include "pass/sunshadow.glsl"
uniform mat4 sunsFromEye;
#endif
#ifdef HAS_BOUNCE
#include "pass/meanradiance.glsl"
#endif
#ifdef HAS_PROBES
#include "pass/probegrid.glsl"
uniform mat4 probesFromEye;  // to their origin
uniform float probeShare;    // the rest is the mean radiance of what blocks light
#endif
#if defined(HAS_SCENE_LIGHT_MAPS) || defined(HAS_AREA_LIGHTS)
#include "pass/pointmap.glsl"
#endif
#ifdef HAS_SCENE_LIGHTS
#include "pass/scenelights.glsl"
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
#include "pass/scenelightmaps.glsl"
uniform mat4 sceneLightMapsFromEye;
#endif
#ifdef HAS_AREA_LIGHTS
#include "pass/emitterpoints.glsl"
uniform mat4 emittersFromEye;
#endif
#include "pass/display.glsl"
#ifdef FOGGED
#include "pass/fog.glsl"
#endif

#ifdef HAS_SPECULAR
uniform sampler2D pyramidMap;
uniform float pyramidSide;
uniform float pyramidLastLevel;
#endif
uniform float radianceScale;
uniform mat3 mapFromEyeForward;

// The frame of the surface's lobe, in eye space.
mat3 frameOf(Surface s)
{
#ifdef HAS_ANISOTROPY
    if (dot(s.brushed, s.brushed) > 0.0) {
        vec3 x = normalize(s.brushed);
        return mat3(x, cross(s.normal, x), s.normal);
    }
#endif
    return frameAround(s.normal);
}

// The direction to the eye in the frame about a normal, above the surface.
vec3 localView(vec3 ray, mat3 frame)
{
    vec3 v = -ray * frame;
    return normalize(vec3(v.xy, max(v.z, 1e-4)));
}

#ifdef HAS_SUNS
float sunShare(int sun, Surface s)
{
#ifdef HAS_SUN_MAPS
    SunPixel q;
    q.point = vec3(sunsFromEye * vec4(s.position, 1.0));
    q.normal = mat3(sunsFromEye) * s.normal;
    q.bulge = s.bulge * length(s.position);
    q.ray = mat3(sunsFromEye) * s.ray;
    q.quantum = 0.0;
    q.footprint = 1.0;
    q.group = bayer4(int(gl_FragCoord.x), int(gl_FragCoord.y));
    return sunSeen(sun, q, 8).x;
#else
    return 1.0;
#endif
}
#endif

// What a surface is made of, its coat and what is below.
struct Layers {
    Bsdf base;
#ifdef HAS_ROUGH_DIFFUSE
    RoughDiffuse diffuse;
#else
    vec3 diffuse;  // albedo of what is below the lobes
#endif
#ifdef HAS_COATS
    Bsdf coat;
#endif
};

Layers layersOf(Surface s)
{
    Layers layers;
    float cosV = max(-dot(s.normal, s.ray), 1e-4);
    layers.base = bsdfOf(s.brdf, s.f0, s.roughness, cosV);
#ifdef HAS_EDGES
    layers.base = withEdge(layers.base, s.edge, cosV);
#endif
#ifdef HAS_ANISOTROPY
    if (s.anisotropy > 0.0) layers.base = anisotropicBsdfOf(s.f0, s.roughness, s.anisotropy, localView(s.ray, frameOf(s)));
#endif
#ifdef HAS_COATS
    vec2 table = lobeAlbedo(BRDF_COOK_TORRANCE, s.coat.roughness, max(-dot(s.coatNormal, s.ray), 1e-4));
    layers.coat = coatBsdf(s.coat, table);
    layers.base = belowCoat(layers.base, layers.coat.reflected);
#endif
#ifdef HAS_ROUGH_DIFFUSE
    layers.diffuse = roughDiffuse(s.albedo * layers.base.body, s.diffuseRoughness);
#else
    layers.diffuse = s.albedo * layers.base.body;
#endif
    return layers;
}

// diffuseOfSky() is the radiance that the diffuse layer reflects of the map; diffuseAlbedo() is its directional albedo;
// diffuseOfDirection() is pi times its BRDF for light from the eye-space direction l.
#ifdef HAS_ROUGH_DIFFUSE
float viewCosine(Surface s)
{
    return max(-dot(s.normal, s.ray), 0.0);
}

vec3 diffuseOfSky(Surface s, Layers layers)
{
    vec3 n = mapFromEyeForward * s.normal;
    return roughDiffuseOfSky(layers.diffuse, n, mapFromEyeForward * -s.ray, irradianceOverPi(n), shCoefficients);
}

vec3 diffuseAlbedo(Surface s, Layers layers)
{
    return roughDiffuseAlbedo(layers.diffuse, viewCosine(s));
}

vec3 diffuseOfDirection(Surface s, Layers layers, vec3 l)
{
    return roughDiffuseBrdf(layers.diffuse, viewCosine(s), max(dot(s.normal, l), 0.0), -dot(s.ray, l));
}
#else
vec3 diffuseOfSky(Surface s, Layers layers)
{
    return layers.diffuse * irradianceOverPi(mapFromEyeForward * s.normal);
}

vec3 diffuseAlbedo(Surface s, Layers layers)
{
    return layers.diffuse;
}

vec3 diffuseOfDirection(Surface s, Layers layers, vec3 l)
{
    return layers.diffuse;
}
#endif

#if defined(HAS_SCENE_LIGHTS) || defined(HAS_AREA_LIGHTS)
// The frames of a surface's lobes, in eye space, and the eye in them.
struct LobeFrames {
    mat3 base;
    vec3 view;
#ifdef HAS_COATS
    mat3 coat;
    vec3 coatView;
#endif
};

LobeFrames lobeFrames(Surface s)
{
    LobeFrames f;
    f.base = frameOf(s);
    f.view = localView(s.ray, f.base);
#ifdef HAS_COATS
    f.coat = frameAround(s.coatNormal);
    f.coatView = localView(s.ray, f.coat);
#endif
    return f;
}

// What the surface's lobes and its diffuse layer send to the eye of light from one direction.
void addLight(Surface s, Layers layers, LobeFrames f, vec3 light, vec3 direction, inout vec3 glint, inout vec3 diffuse)
{
    vec3 l = direction * f.base;
    diffuse += light * lightLambert(diffuseOfDirection(s, layers, direction), l);
    glint += light * lightLobe(layers.base, f.view, l);
#ifdef HAS_COATS
    glint += light * lightLobe(layers.coat, f.coatView, direction * f.coat);
#endif
}
#endif

#ifdef HAS_SCENE_LIGHTS
void addSceneLights(Surface s, Layers layers, inout vec3 glint, inout vec3 diffuse)
{
    LobeFrames frames = lobeFrames(s);
    for (int i = 0; i < sceneLightCount; ++i) {
        vec3 direction;
        vec3 light = sceneLightAt(i, s.position, direction);
#ifdef HAS_SCENE_LIGHT_MAPS
        light *= sceneLightSeen(i, vec3(sceneLightMapsFromEye * vec4(s.position, 1.0)), mat3(sceneLightMapsFromEye) * s.normal);
#endif
        addLight(s, layers, frames, light, direction, glint, diffuse);
    }
}
#endif

#ifdef HAS_AREA_LIGHTS
// By all of their points: no pixel has neighbours whose points it could share.
void addAreaLights(Surface s, Layers layers, inout vec3 glint, inout vec3 diffuse)
{
    mat3 worldFromEye = mat3(emittersFromEye);
    vec3 point = vec3(emittersFromEye * vec4(s.position, 1.0));
    vec3 normal = worldFromEye * s.normal;
    LobeFrames frames = lobeFrames(s);
    EmitterSums sums = EmitterSums(vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 reflected = vec3(0.0);
    vec3 scattered = vec3(0.0);
    int count = textureSize(emitterPointMap, 0).x;
    for (int i = 0; i < count; ++i) {
        EmitterPoint e = emitterPoint(i);
        vec3 to = e.position - point;
        float kernel = emitterKernel(e, to, normal);
        if (kernel <= 0.0) continue;
        float seen = emitterSees(e, point, normal);
        sums = withPoint(sums, kernel * e.power, seen);
        if (seen <= 0.0) continue;
        vec3 direction = normalize(to);
        vec3 light = e.power * (seen * kernel / dot(normal, direction));
        addLight(s, layers, frames, light, direction * worldFromEye, reflected, scattered);
    }
    glint += reflected * knownScale(sums);
    diffuse += scattered * knownScale(sums);
}
#endif

#ifdef HAS_SPECULAR
// What the lobe sends to the eye of the map, over its albedo. Half of a GGX lobe's energy lies within a cone of about tan = alpha.
vec3 mirrored(Bsdf b, vec3 ray, vec3 normal)
{
    float lod = log2(max(evenAlpha(b) * pyramidSide, 1.0));
    return pyramidLookup(pyramidMap, pyramidSide, pyramidLastLevel, mapFromEyeForward * reflect(ray, normal), lod);
}
#endif

// Radiance that comes from the surfaces about.
struct SurfacesAbout {
    vec3 received;  // what a white surface sends on of it
    vec3 mirrored;  // its mean about the mirror direction
};

SurfacesAbout surfacesAbout(Surface s, float hidden)
{
    SurfacesAbout about = SurfacesAbout(vec3(0.0), vec3(0.0));
    vec3 d = reflect(s.ray, s.normal);
#ifdef HAS_BOUNCE
    about = SurfacesAbout(hidden * meanRadiance(s.normal), meanRadiance(d));
#endif
#ifdef HAS_PROBES
    mat3 turn = mat3(probesFromEye);
    vec3 n = turn * s.normal;
    ProbesAbout probes = probesAbout(vec3(probesFromEye * vec4(s.position, 1.0)), n, turn * -s.ray);
    about.received = mix(about.received, radianceScale * receivedFrom(sentAbout(probes, n), hidden), probeShare);
    about.mirrored = mix(about.mirrored, radianceScale * sentAbout(probes, turn * d).radiance, probeShare);
#endif
    return about;
}

// What the host draws to, and the coverage: what a surface mirrors does not fade with its transparency.
vec4 forwardColor(Surface s)
{
    Layers layers = layersOf(s);
    Bsdf b = layers.base;
    vec3 radiance = s.emission;
    float alpha = s.alpha;
    vec3 mapNormal = mapFromEyeForward * s.normal;
    SkySeen seen = skySeen(s);
    SurfacesAbout about = surfacesAbout(s, 1.0 - seen.ambient);
    vec3 diffuse = diffuseOfSky(s, layers) * seen.light;
    vec3 sunGlint = vec3(0.0);
#ifdef HAS_SUNS
    mat3 mapFromLocal = mapFromEyeForward * frameOf(s);
    vec3 local = localView(mapFromEyeForward * s.ray, mapFromLocal);
    Bsdf shiny = b;  // a sun's mirror image is a disc of few pixels
    shiny.roughness = max(b.roughness, 0.03);
#ifdef HAS_COATS
    mat3 mapFromCoat = frameAround(mapFromEyeForward * s.coatNormal);
    vec3 coatLocal = localView(mapFromEyeForward * s.ray, mapFromCoat);
    Bsdf shinyCoat = layers.coat;
    shinyCoat.roughness = max(shinyCoat.roughness, 0.03);
#endif
    for (int i = 0; i < sunCount; ++i) {
        vec3 sun = sunShare(i, s) * sunRadiance[i];
#ifdef SUN_DIFFUSE
        diffuse += sun * diffuseOfDirection(s, layers, sunDirection[i] * mapFromEyeForward) *
                   discIrradianceOverPi(dot(mapNormal, sunDirection[i]), sunRadius[i]);
#endif
#ifdef HAS_SPECULAR
        sunGlint += sun * bsdfDisc(shiny, sunDirection[i] * mapFromLocal, local, sunRadius[i]);
#ifdef HAS_COATS
        sunGlint += sun * bsdfDisc(shinyCoat, sunDirection[i] * mapFromCoat, coatLocal, sunRadius[i]);
#endif
#endif
    }
#endif
    diffuse *= radianceScale;
    vec3 sceneGlint = vec3(0.0);
#ifdef HAS_SCENE_LIGHTS
    addSceneLights(s, layers, sceneGlint, diffuse);
#endif
#ifdef HAS_AREA_LIGHTS
    addAreaLights(s, layers, sceneGlint, diffuse);
#endif
    if (s.brdf != BRDF_LAMBERT) {
        vec3 glint = sceneGlint;
        vec3 reflected = b.reflected;
#ifdef HAS_COATS
        reflected += layers.coat.reflected;
#endif
#ifdef HAS_SPECULAR
        vec3 sky = b.reflected * mirrored(b, s.ray, s.normal);
#ifdef HAS_COATS
        sky += layers.coat.reflected * mirrored(layers.coat, s.ray, s.coatNormal);
#endif
        glint += (sky * seen.lobe + sunGlint) * radianceScale;
        glint += reflected * (1.0 - seen.lobe) * about.mirrored;
#endif
        // A reflection does not fade with the body's transparency: blending multiplies by alpha, so alpha rises with it.
        float strength = max(reflected.r, max(reflected.g, reflected.b));
        alpha = mix(s.alpha, 1.0, clamp(strength, 0.0, 1.0));
        radiance += glint / max(alpha, 1e-3);
    }
    diffuse += diffuseAlbedo(s, layers) * about.received;
    radiance += diffuse * (s.alpha / max(alpha, 1e-3));
#ifdef FOGGED
    radiance = mix(fogRadiance, radiance, fogLeaves(s.position));
#endif
    return vec4(display(radiance, isUnlit(s.brdf, s.roughness) ? 0.0 : adaptedStops(), ivec2(gl_FragCoord.xy)), alpha);
}

#endif
