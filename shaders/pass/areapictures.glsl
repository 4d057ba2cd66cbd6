// SPDX-License-Identifier: MIT
// Pictures on area lights. Closed forms use a light's mean radiance. This file gives the factor from that to the mean radiance of the
// part that a lobe sees: the first of the two ratios of area-lights.md 0.
#ifndef AREAPICTURES_GLSL
#define AREAPICTURES_GLSL

#include "lib/constants.glsl"
#include "lib/ltc.glsl"
#include "pass/arealights.glsl"

uniform sampler2DArray areaPictureMap; // by layer: radiance over the light's mean radiance

// Samples of the lobe, and along each side of the light.
const int LOBE_SAMPLES = 16;
const int SIDE_SAMPLES = 4;

// The direction of the cosine lobe's w, back in the lobe's frame; of any length.
vec3 fromCosineLobe(Ltc lobe, vec3 w)
{
    float determinant = lobe.inverse.x * lobe.inverse.w - lobe.inverse.y * lobe.inverse.z;
    return vec3(lobe.inverse.w * w.x - lobe.inverse.y * w.z, determinant * w.y, lobe.inverse.x * w.z - lobe.inverse.z * w.x) * sign(determinant);
}

// The lobe of a surface that scatters evenly.
Ltc cosineLobe()
{
    return Ltc(vec4(1.0, 0.0, 0.0, 1.0), 0.0);
}

// A light that shows a picture, in the frame of a lobe.
struct PictureView {
    AreaLight light;
    Ltc lobe;
    vec3 normal;  // of the lit side; as long as a quarter of the area
    float area;
};

// One sample: the picture's colour at place, times the sample's weight; alpha: the weight. place: from -1 to 1 each way. l: the unit
// direction to it. Samples of the lobe and of the light are weighted by the balance heuristic [Veach 1997]. The joint density of both
// gives the sample's share of the picture, and that share the level of detail.
vec4 shownAt(PictureView v, vec2 place, vec3 l, float squareDistance)
{
    float slant = -dot(v.normal, l) * 4.0 / v.area;
    if (slant <= 0.0 || l.z <= 0.0) return vec4(0.0);
    float density = ltcDensity(v.lobe, l);
    float samples = float(LOBE_SAMPLES) * density + float(SIDE_SAMPLES * SIDE_SAMPLES) * squareDistance / (v.area * slant);
    float part = squareDistance / (slant * v.area * samples);
    float side = float(textureSize(areaPictureMap, 0).x);
    // A sample fades out as its share leaves the picture, or bands would show.
    float inside = clamp(0.5 + (1.0 - max(abs(place.x), abs(place.y))) / (4.0 * sqrt(part)), 0.0, 1.0);
    vec2 st = 0.5 + 0.5 * clamp(vec2(place.x, place.y * v.light.pictureUp), -1.0, 1.0);
    float lod = 0.5 * log2(part) + log2(side) - 1.0;
    vec3 shown = textureLod(areaPictureMap, vec3(st, float(v.light.picture)), lod).rgb;
    return vec4(shown, 1.0) * (inside * density / samples);
}

vec4 shownByLobe(PictureView v)
{
    vec4 sum = vec4(0.0);
    float height = dot(v.normal, v.light.center);
    for (int j = 0; j < LOBE_SAMPLES; ++j) {
        float square = (float(j) + 0.5) / float(LOBE_SAMPLES);
        float angle = 2.39996323 * float(j);
        vec3 l = normalize(fromCosineLobe(v.lobe, vec3(sqrt(square) * vec2(cos(angle), sin(angle)), sqrt(1.0 - square))));
        float distance = height / min(dot(v.normal, l), -1e-20);
        vec3 p = distance * l - v.light.center;
        vec2 place = vec2(dot(cross(p, v.light.v), v.normal), dot(cross(v.light.u, p), v.normal)) / dot(v.normal, v.normal);
        if (distance > 0.0) sum += shownAt(v, place, l, distance * distance);
    }
    return sum;
}

vec4 shownByLight(PictureView v)
{
    vec4 sum = vec4(0.0);
    for (int j = 0; j < SIDE_SAMPLES * SIDE_SAMPLES; ++j) {
        vec2 place = (2.0 * vec2(float(j % SIDE_SAMPLES), float(j / SIDE_SAMPLES)) + 1.0) / float(SIDE_SAMPLES) - 1.0;
        vec3 to = v.light.center + place.x * v.light.u + place.y * v.light.v;
        float square = max(dot(to, to), 1e-30);
        sum += shownAt(v, place, to * inversesqrt(square), square);
    }
    return sum;
}

// The mean over the lobe of a light's radiance over its mean radiance. The light has a picture, and is in the lobe's frame.
vec3 shownThrough(AreaLight a, Ltc lobe)
{
    vec3 n = cross(a.u, a.v);
    PictureView v = PictureView(a, lobe, n, 4.0 * length(n));
    vec4 sum = shownByLobe(v) + shownByLight(v);
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
}

#endif
