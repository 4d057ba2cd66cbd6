// SPDX-License-Identifier: MIT
// The shadow maps of the suns, in the world about their origin, and how much of a sun a surface sees.
#ifndef PASS_SUNSHADOW_GLSL
#define PASS_SUNSHADOW_GLSL

#include "lib/bulge.glsl"
#include "lib/sunshadow.glsl"
#include "pass/suns.glsl"

uniform sampler2D sunShadowMaps; // a row for each sun, the map of the whole scene first
uniform int sunMapSize;          // of a map, in texels
uniform int sunShadowLevels;     // maps of a sun
uniform vec3 sunAxes[3 * MOST_SUNS]; // of each sun across, up, towards it
uniform vec2 sunHeights[MOST_SUNS];  // lowest and highest point along the third
// Of each map of a sun: texels per unit of the world along the first two axes, and the offsets.
uniform vec4 sunLevels[MOST_SUN_LEVELS * MOST_SUNS];

// A surface in a pixel, in the world about that origin.
struct SunPixel {
    vec3 point;
    vec3 normal;
    float bulge;    // of the smooth surface that the normals stand for above the point
    vec3 ray;       // from the eye
    float quantum;  // a step of the depth buffer along it
    float footprint;
    int group;      // in its cell
};

vec2 sunTexels(vec4 level, int sun, vec3 point)
{
    return vec2(dot(point, sunAxes[3 * sun]), dot(point, sunAxes[3 * sun + 1])) * level.xy + level.zw;
}

// The finest map that shows the point; own: its element of sunLevels. Pixels of a cell change from a map to the next at different
// distances, over a sixteenth of its width, which hides the border.
SunMap sunMapAt(int sun, SunPixel s, out vec4 own)
{
    vec4 whole = sunLevels[MOST_SUN_LEVELS * sun];
    float size = float(sunMapSize);
    float margin = 2.0 + size / 16.0 * (float(s.group) + 0.5) / 16.0;
    int level = 0;
    own = whole;
    for (int i = 1; i < MOST_SUN_LEVELS; ++i) {
        vec4 finer = sunLevels[MOST_SUN_LEVELS * sun + i];
        vec2 xy = sunTexels(finer, sun, s.point);
        bool shows = i < sunShadowLevels && finer.x > 0.0 && min(xy.x, xy.y) >= margin && max(xy.x, xy.y) <= size - margin;
        level = shows ? i : level;
        own = shows ? finer : own;
    }
    SunMap m;
    m.corner = ivec2(level, sun) * sunMapSize;
    m.size = sunMapSize;
    m.heights = (sunHeights[sun].y - sunHeights[sun].x) * max(own.x, own.y);
    m.longer = max(own.x, own.y) / min(own.x, own.y);
    m.wholeCorner = ivec2(0, sun) * sunMapSize;
    m.toWhole = whole.xy / own.xy;
    m.wholeOffset = whole.zw - own.zw * m.toWhole;
    return m;
}

// A point of the disc that the surface of normal n faces: the given one, else the one opposite, else the one that it faces most. A point
// that it does not face says nothing about shadows; counted as seen, it would light shaded walls that the sun grazes.
vec2 facedPoint(vec3 n, float spread, vec2 point)
{
    float rise = dot(n.xy, point);
    if (n.z + rise > 0.0) return point;
    return n.z - rise > 0.0 ? -point : n.xy * (spread / max(length(n.xy), 1e-20));
}

// Share of the sun's light on the surface that reaches it, by rays to count points of the disc; and the width of the
// penumbra there in pixels, 0 where nothing hides it. The plane's own horizon is not counted.
vec2 sunSeen(int sun, SunPixel s, int count)
{
    float spread = tan(sunRadius[sun]);
    vec3 n = vec3(dot(s.normal, sunAxes[3 * sun]), dot(s.normal, sunAxes[3 * sun + 1]), dot(s.normal, sunAxes[3 * sun + 2]));
    if (n.z <= -spread) return vec2(1.0, 0.0);
    vec4 level;
    SunMap m = sunMapAt(sun, s, level);
    float finest = max(level.x, level.y);
    vec2 perHeight = level.xy / finest; // texels across that are as long as one of height
    SunReceiver r;
    r.point = vec3(sunTexels(level, sun, s.point), (dot(s.point, sunAxes[3 * sun + 2]) - sunHeights[sun].x) * finest);
    float up = max(n.z, 0.02); // below, the surface hardly sees the sun
    r.gradient = -n.xy / (up * perHeight);
    float steep = 1.0 + length(r.gradient);
    float within = abs(dot(s.normal, s.ray)) * s.quantum + bulgeUnderSun(s.bulge, n.z);
    r.slack = 0.05 * steep + within * finest / up;
    r.body = 3.0 * steep;
    float seen = 0.0;
    float all = 0.0;
    float height = 0.0;
    float hidden = 0.0;
    for (int k = 0; k < count; ++k) {
        vec2 across = facedPoint(n, spread, spread * sunDiscPoint(k, count, s.group));
        float cosine = n.z + dot(n.xy, across);
        if (cosine <= 0.0) continue;
        all += cosine;
        float h = sunBlocker(sunShadowMaps, m, r, r.point.xy + sunTexelPoint(k, s.group),
                             across * perHeight);
        if (h < 0.0) {
            seen += cosine;
        } else {
            height += h;
            hidden += 1.0;
        }
    }
    if (all <= 0.0) return vec2(1.0, 0.0);
    if (hidden <= 0.0) return vec2(1.0, 0.0);
    // A texel's edge is scattered over its width.
    float width = inversesqrt(level.x * level.y) + 2.0 * spread * height / (hidden * finest);
    return vec2(seen / all, min(width / s.footprint, 1000.0));
}

#endif
