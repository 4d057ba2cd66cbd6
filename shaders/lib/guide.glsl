// SPDX-License-Identifier: MIT
// A guide: a sphere about some of a scene's brightest surface points, to which rays are aimed. Rays fill the cone about it evenly.
#ifndef GUIDE_GLSL
#define GUIDE_GLSL

#include "lib/constants.glsl"
#include "lib/frame.glsl"

// A guide's number and a share in 16 bits. share: 0 to 1, in steps of 15 %; what is less than a 5000th is 0.
uint packGuide(int number, float share)
{
    float code = share > 0.0 ? floor(-5.0 * log2(min(share, 1.0)) + 0.5) : 63.0;
    return code < 63.0 ? uint(number) << 6 | uint(code) : 63u;
}

int guideNumber(uint code)
{
    return int(code >> 6);
}

float guideShare(uint code)
{
    float step = float(code & 63u);
    return step < 63.0 ? exp2(-0.2 * step) : 0.0;
}

// 1 - the cosine of half the cone's angle; 2, all directions, from inside of the sphere. to: to its centre.
float guideOpening(vec3 to, float radius)
{
    float sine2 = radius * radius / max(dot(to, to), 1e-30);
    return sine2 < 1.0 ? sine2 / (1.0 + sqrt(1.0 - sine2)) : 2.0;
}

// The radiance that a white surface with normal n would send on of the guide's light, estimated from what a probe sees of the guide.
// seen: the part of the probe's mean radiance that comes from the guide. toProbe: from the guide's centre.
float guideWeight(vec3 to, float radius, vec3 n, float seen, vec3 toProbe)
{
    float least = radius * radius;
    float distance2 = max(dot(to, to), max(least, 1e-30));
    float inverse = 1.0 / sqrt(distance2);
    float received = clamp(dot(n, to) * inverse + radius * inverse, 0.0, 1.0);
    return 4.0 * seen * received * max(dot(toProbe, toProbe), least) / distance2;
}

// Of unit length.
vec3 guideDirection(vec3 to, float radius, vec2 u)
{
    float opening = guideOpening(to, radius);
    float x = u.x * opening;
    float sine = sqrt(max(x * (2.0 - x), 0.0));
    float azimuth = TWO_PI * u.y;
    vec3 axis = to / sqrt(max(dot(to, to), 1e-30));
    if (dot(axis, axis) < 0.5) axis = vec3(0.0, 0.0, 1.0);
    return frameAround(axis) * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - x);
}

// How densely such directions lie about direction d, per solid angle.
float guideDensity(vec3 to, float radius, vec3 d)
{
    float opening = guideOpening(to, radius);
    if (opening >= 2.0) return 0.5 / TWO_PI;
    vec3 off = d - to / sqrt(max(dot(to, to), 1e-30));
    return 0.5 * dot(off, off) <= opening ? 1.0 / (TWO_PI * opening) : 0.0;
}

#endif
