#version 330 compatibility
// SPDX-License-Identifier: MIT
// The bright places that a probe sees. Surface points that follow each other are neighbours. Each GUIDE_POINTS of them make a guide: a
// sphere about those that are bright. The first rows have a texel for each probe. It holds the guides that send the probe most light, two
// in each channel, as packGuide() says. The last rows have a texel for each guide: its sphere.
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

// A direction is bright if its radiance is this many times the usual one at the probe. Noise (RMS) of single rays: in a living room with a shaded
// lamp .255 without guides, and .12 to .15 with 2, 4 and 8; in a sunlit atrium .0138 without, .0127 and .0116 with 2 and 4.
const float BRIGHT = 4.0;

float sentLuminance(float code)
{
    return max(luminance(linkSends(code).rgb), 0.0);
}

// About those of its points that are not far less bright than the brightest.
vec4 sphereOf(int number)
{
    vec4 places[GUIDE_POINTS];
    float most = 0.0;
    for (int i = 0; i < GUIDE_POINTS; ++i) {
        ivec2 texel = pointTexel(GUIDE_POINTS * number + i);
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

// Adds light to that of a guide. A guide that is not among them replaces the weakest and takes over its sum
// [Space-Saving: Metwally, Agrawal, El Abbadi 2005].
void countLight(int number, float light, inout Strongest found)
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
float usualLuminance(int probe, int directions)
{
    float sum = 0.0;
    for (int i = 0; i < directions; ++i) sum += sqrt(sentLuminance(texelFetch(probeLinkMap, ivec2(i, probe), 0).r));
    float mean = sum / float(directions);
    return mean * mean;
}

uvec4 guidesOf(int probe)
{
    int directions = textureSize(probeBasisMap, 0).x;
    float least = BRIGHT * usualLuminance(probe, directions);
    Strongest found;
    for (int k = 0; k < GUIDES; ++k) {
        found.number[k] = -1;
        found.light[k] = 0.0;
    }
    for (int i = 0; i < directions; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, probe), 0);
        for (int k = 0; k < 4; ++k) {
            float sent = sentLuminance(codes[k]);
            if (sent > least) countLight(linkedPoint(codes[k]) / GUIDE_POINTS, sent * sent, found);
        }
    }
    for (int k = 0; k < GUIDES; ++k) found.light[k] = 0.0;
    float all = 1e-20;
    for (int i = 0; i < directions; ++i) {
        vec4 codes = texelFetch(probeLinkMap, ivec2(i, probe), 0);
        float weight = texelFetch(probeBasisMap, ivec2(i, 0), 0).r;  // the direction's solid angle, times a constant
        for (int k = 0; k < 4; ++k) {
            float sent = weight * sentLuminance(codes[k]);
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
