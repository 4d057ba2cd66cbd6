#version 330 compatibility
// SPDX-License-Identifier: MIT
// Bright places about a probe, from which few directions bring much of its light. Surface points that follow each other are neighbours:
// GUIDE_POINTS of them are a guide, a sphere about those of them that are bright. A texel is a probe: the guides that send it most, two in
// each number, as packGuide() says. The rows after the probes' have the guides' spheres.
#include "lib/guide.glsl"
#include "lib/limits.glsl"
#include "lib/tone.glsl"
#include "pass/pointlink.glsl"

uniform sampler2D pointPlaceMap;
uniform sampler2D probeLinkMap;
uniform sampler2D probeBasisMap;
uniform int probeColumns;
uniform float pointSpacing;  // side of the square that a point stands for

layout(location = 0) out uvec4 guide;

// RMS of single rays in a living room with a shaded lamp: .255 without guides; .12 to .15 with 2, 4, 8 here, which is chance. In an atrium
// with the sun .0138; .0127, .0116 with 2, 4.
const float BRIGHT = 4.0;  // times what a probe sees on the whole

float brightness(float code)
{
    return max(luminance(linkSends(code).rgb), 0.0);
}

// About those of its points that are not far less bright than the brightest.
vec4 sphereOf(int number)
{
    vec4 places[GUIDE_POINTS];
    float most = 0.0;
    for (int i = 0; i < GUIDE_POINTS; ++i) {
        int point = GUIDE_POINTS * number + i;
        ivec2 texel = ivec2(point % POINT_SIDE, point / POINT_SIDE);
        places[i] = vec4(texelFetch(pointPlaceMap, texel, 0).xyz, luminance(texelFetch(pointRadianceMap, texel, 0).rgb));
        most = max(most, places[i].w);
    }
    vec4 sum = vec4(0.0);
    for (int i = 0; i < GUIDE_POINTS; ++i)
        if (places[i].w >= most / BRIGHT) sum += vec4(places[i].xyz, 1.0);
    vec3 center = sum.xyz / max(sum.w, 1.0);
    float radius = 0.0;
    for (int i = 0; i < GUIDE_POINTS; ++i)
        if (places[i].w >= most / BRIGHT) radius = max(radius, length(places[i].xyz - center));
    return vec4(center, radius + pointSpacing);
}

struct Strongest {
    int number[GUIDES];
    float light[GUIDES];
};

// What is not yet among them takes the place of the weakest, and its count [Metwally, Agrawal, El Abbadi 2005].
void count(int number, float light, inout Strongest found)
{
    int at = 0;
    for (int k = 0; k < GUIDES; ++k) {
        if (found.number[k] == number) at = k;
        else if (found.number[at] != number && found.light[k] < found.light[at]) at = k;
    }
    found.number[at] = number;
    found.light[at] += light;
}

// The square of the mean of the square roots: few bright directions hardly change it.
float usualBrightness(int probe, int directions)
{
    float sum = 0.0;
    for (int i = 0; i < directions; ++i) sum += sqrt(brightness(texelFetch(probeLinkMap, ivec2(i, probe), 0).r));
    float mean = sum / float(directions);
    return mean * mean;
}

uvec4 guidesOf(int probe)
{
    int directions = textureSize(probeBasisMap, 0).x;
    float least = BRIGHT * usualBrightness(probe, directions);
    Strongest found;
    for (int k = 0; k < GUIDES; ++k) {
        found.number[k] = -1;
        found.light[k] = 0.0;
    }
    for (int i = 0; i < directions; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, probe), 0);
        for (int k = 0; k < 4; ++k) {
            float sent = brightness(codes[k]);
            if (sent > least) count(linkedPoint(codes[k]) / GUIDE_POINTS, sent * sent, found);
        }
    }
    for (int k = 0; k < GUIDES; ++k) found.light[k] = 0.0;
    float all = 1e-20;
    for (int i = 0; i < directions; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, probe), 0);
        float weight = texelFetch(probeBasisMap, ivec2(i, 0), 0).r;  // the direction's solid angle, times a constant
        for (int k = 0; k < 4; ++k) {
            float sent = weight * brightness(codes[k]);
            all += sent;
            if (sent <= 0.0) continue;
            int number = linkedPoint(codes[k]) / GUIDE_POINTS;
            for (int j = 0; j < GUIDES; ++j) found.light[j] += found.number[j] == number ? sent : 0.0;
        }
    }
    uvec4 guides = uvec4(0u);
    for (int k = 0; k < GUIDES; ++k) guides[k / 2] |= packGuide(found.number[k], found.light[k] / all) << uint(16 * (k & 1));
    return guides;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    int side = probeColumns + GUIDE_ROWS;
    int probe = p.y * probeColumns + p.x;
    guide = uvec4(0u);
    if (p.y >= probeColumns) {
        int number = (p.y - probeColumns) * side + p.x;
        if (GUIDE_POINTS * number < POINT_SIDE * POINT_SIDE) guide = floatBitsToUint(sphereOf(number));
    } else if (p.x < probeColumns && probe < textureSize(probeLinkMap, 0).y) {
        guide = guidesOf(probe);
    }
}
