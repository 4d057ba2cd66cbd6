// SPDX-License-Identifier: MIT
// The light that comes to a pixel of a still view along a path through the scene's triangles. At each surface the path follows either its
// diffuse layer or its lobe. This frame's lights light diffuse layers; the probes say what the last surface receives from further ones.
#ifndef PATHLIGHT_GLSL
#define PATHLIGHT_GLSL
#pragma import_defines(MAP_IS_BLACK, HAS_SUNS)

#include "lib/frame.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "pass/atlas.glsl"
#include "pass/guidedray.glsl"
#include "pass/maplight.glsl"
#include "pass/pixelray.glsl"
#include "pass/probegrid.glsl"
#include "pass/tracedscene.glsl"
#include "pass/receivedlight.glsl"
#ifdef HAS_SUNS
#include "pass/suns.glsl"
#endif

uniform vec3 placesInAtlas;
uniform float sceneRadius;

// The frame's lights light so many surfaces along a path. The probes, into which light leaks, stand for all surfaces behind them. A room
// with a slot for a window after 64 frames, beside full light transport: 16.1, 11.6, 9.5 % with 1, 2, 3; 26.1 % by probes alone.
const int PATH_SURFACES = 3;
const float LEAVE = 1e-4;  // distance from a surface at which a ray begins there, in radii of the scene

// A surface on a path. Places are about the origin of the triangles.
struct PathSurface {
    vec3 place;
    vec3 normal;
    vec3 view;  // to where the path comes from
    TracedLayers layers;
};

PathSurface pathSurface(SceneHit met, vec3 origin, vec3 along)
{
    return PathSurface(origin + met.distance * along, smoothNormal(rayTriangleMap, met), -along, tracedLayers(met.surface));
}

// A surface's lobe is taken for GGX's.
struct PathLobe {
    mat3 placesFromLocal;
    vec3 view;  // local
    vec3 f0;
    float alpha;
    float lampAlpha;  // for lamps and suns
};

// blur: the largest roughness of the lobes before on the path. The lobe reflects lamps as if it were at least that rough: a sharp lamp
// that few paths find would be noise.
PathLobe pathLobe(PathSurface s, float blur)
{
    PathLobe l;
    l.placesFromLocal = frameAround(s.normal);
    vec3 v = s.view * l.placesFromLocal;
    l.view = normalize(vec3(v.x, v.y, max(v.z, 1e-4)));
    // The mean of Schlick's form over all directions is a 21st of the way from F0 to 1.
    l.f0 = max((21.0 * s.layers.glossy - 1.0) / 20.0, vec3(0.0));
    l.alpha = s.layers.roughness * s.layers.roughness;
    float least = max(s.layers.roughness, blur);
    l.lampAlpha = max(least * least, 0.01);
    return l;
}

// Lights of which polished metal on the path sends nothing, as receive() numbers them: virtual lights stand for that.
int leftOutLights = 0;

bool isPolished(TracedLayers layers)
{
    return max(layers.glossy.r, max(layers.glossy.g, layers.glossy.b)) >= LEAST_POLISHED && layers.roughness <= MOST_POLISHED_ROUGHNESS;
}

// That sentShare() asks about. Diffuse layers ask, too, and leave the answer.
PathLobe lampLobe = PathLobe(mat3(1.0), vec3(0.0, 0.0, 1.0), vec3(0.0), 1.0, 1.0);

// pi times the lobe's value, without Fresnel.
float sentShare(vec3 l, vec3 place, vec3 n, int number)
{
    if ((leftOutLights >> number & 1) == 1) return 0.0;
    return PI * ggxBrdf(lampLobe.view, l * lampLobe.placesFromLocal, lampLobe.lampAlpha);
}

void receiveLamps(vec3 place, vec3 n, inout ReceivedLight sum)
{
#ifdef HAS_AREA_LIGHTS
    receiveAreaLights(place, n, sum);
#endif
#ifdef HAS_SCENE_LIGHT_MAPS
    receiveSceneLights(place, n, sum);
#endif
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
        float sees = atlasSees(l, place + placesInAtlas, n);
        all += c * l.solidAngle;
        seen += sees * c * l.solidAngle;
#ifndef MAP_IS_BLACK
        sum.all += sees * c * INV_PI * l.flux;
#endif
    }
    receiveLamps(place, n, sum);
    if (isLast) sum.all += receivedFrom(sentAbout(probesAbout(place, n, n), n), all > 0.0 ? 1.0 - seen / all : 0.0);
    return sum.all;
}

SceneHit nextHit(vec3 origin, vec3 along)
{
    return sceneHit(rayNodeMap, rayTriangleMap, origin, along, 4.0 * sceneRadius, STOPS_BY_PLACE);
}

// What a lobe sends of lamps and suns. The path's next ray finds the rest of the map.
vec3 lampsInLobe(PathSurface s, vec3 origin, PathLobe lobe)
{
    vec3 sum = vec3(0.0);
    lampLobe = lobe;
    ReceivedLight lamps = ReceivedLight(vec3(0.0), vec3(0.0));
    receiveLamps(s.place, s.normal, lamps);
    sum += lamps.sentOn;
#ifdef HAS_SUNS
    mat3 placesFromMap = mat3(placesFromEye) * transpose(mapFromEye);
    for (int i = 0; i < sunCount; ++i) {
        vec3 l = placesFromMap * sunDirection[i];
        if (dot(l, s.normal) <= 0.0) continue;
        float e = discIrradianceOverPi(dot(l, s.normal), sunRadius[i]);
        if (nextHit(origin, l).distance == MISSED) sum += e * sentShare(l, s.place, s.normal, FIRST_SUN + i) * sunRadiance[i];
    }
#endif
    return sum * fresnelSchlick(lobe.f0, lobe.view.z);
}

// Radiance of the map, without suns, in a direction that is drawn as densely as that.
vec3 mapAlong(vec3 along, float density)
{
#ifdef MAP_IS_BLACK
    return vec3(0.0);
#else
    vec3 d = mapFromEye * (along * mat3(placesFromEye));
    return filtered(d, lodOfUnitDensity(sampleFrames) - 0.5 * log2(max(density, 1e-10)));
#endif
}

float brightness(vec3 c)
{
    return c.r + c.g + c.b;
}

// The light that surface s sends back along the path, without its own emission, in units of the map's mean. blur: as in pathLobe().
// virtualLights: suns and lamps for whose reflection virtual lights stand, as bits. If s is polished metal, it sends nothing of them here.
// pixel, ray: numbers that no other ray has.
vec3 pathLight(PathSurface s, float blur, int virtualLights, uint pixel, uint ray)
{
    vec3 sum = vec3(0.0);
    vec3 reflected = vec3(1.0);
    for (int i = 0; i < PATH_SURFACES; ++i) {
        bool isLast = i + 1 == PATH_SURFACES;
        uint number = 4u * (uint(PATH_SURFACES) * ray + uint(i));
        vec2 u = vec2(pixelNumber(pixel, number), pixelNumber(pixel, number + 1u));
        float chance = brightness(s.layers.glossy) / max(brightness(s.layers.diffuse + s.layers.glossy), 1e-20);
        bool isLobe = !isLast && pixelNumber(pixel, number + 2u) < chance;
        vec3 origin = s.place + LEAVE * sceneRadius * s.normal;
        vec3 along;
        float density = 0.0;
        if (isLobe) {
            PathLobe lobe = pathLobe(s, blur);
            leftOutLights = i == 0 && isPolished(s.layers) ? virtualLights : 0;
            sum += reflected / chance * lampsInLobe(s, origin, lobe);
            leftOutLights = 0;
            vec3 h = ggxVisibleNormalSample(lobe.view, lobe.alpha, u);
            vec3 l = 2.0 * dot(lobe.view, h) * h - lobe.view;
            l.z = abs(l.z);  // facets reflect again what others send down to them
            density = ggxReflectionPdf(lobe.view, h, max(lobe.alpha, 1e-4));
            along = lobe.placesFromLocal * l;
            reflected *= fresnelSchlick(lobe.f0, dot(lobe.view, h)) / chance;
            blur = max(blur, s.layers.roughness);
        } else {
            reflected *= isLast ? s.layers.diffuse + s.layers.glossy : s.layers.diffuse / (1.0 - chance);
            sum += reflected * lightAt(s.place, s.normal, isLast);
            GuidedRay next = guidedRay(origin, s.normal, u, pixelNumber(pixel, number + 3u));
            along = next.along;
            reflected *= next.weight;
            blur = 1.0;
        }
        if (isLast || max(reflected.r, max(reflected.g, reflected.b)) <= 0.0) break;
        SceneHit met = nextHit(origin, along);
        if (met.distance == MISSED) {
            if (isLobe) sum += reflected * mapAlong(along, density);
            break;
        }
        s = pathSurface(met, origin, along);
        sum += reflected * tracedEmission(met) / radianceScale;
    }
    return sum;
}

#endif
