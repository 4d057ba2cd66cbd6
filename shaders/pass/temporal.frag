#version 330 compatibility
// SPDX-License-Identifier: MIT
// The picture, averaged over the frames before: each pixel's surface is looked up where the picture before showed it, and what
// is found there is bounded by what is about the pixel now.
#pragma import_defines(HISTORY, ACCUMULATED, MOTION, HAS_CATCHERS)

#include "lib/brdfs.glsl"
#include "lib/colorbox.glsl"
#include "lib/depth.glsl"
#include "pass/history.glsl"

uniform sampler2D displayMap;  // this frame's, in display values
uniform sampler2D depthMap;
#ifdef HAS_CATCHERS
uniform sampler2D normalMap;
uniform sampler2D specularMap;
#endif
uniform mat4 projection;
uniform mat4 inverseProjection;
uniform vec2 viewportSize;
#ifdef HISTORY
uniform sampler2D historyMap;  // the picture so far
uniform sampler2D placeMap;    // and where its surfaces are [packPlace()]
#endif
#ifdef ACCUMULATED
uniform float accumulatedShare;
#elif defined(HISTORY)
uniform mat4 formerEyeFromEye;
uniform mat4 formerProjection;
uniform vec2 subpixel;  // shift of this frame's picture
#endif
#ifdef MOTION
uniform sampler2D motionMap;  // of what has moved [pass/motion.frag]
#endif

layout(location = 0) out vec4 shown;
layout(location = 1) out float place;

const float BEHIND_ALL = 1e30;
const float HISTORY_DEVIATIONS = 1.25;   // of the colours about a pixel that a former one may be off their mean,
const float HISTORY_STEP = 1.0 / 255.0;  // and as much of the display's range beyond
const float SHARPNESS = 0.65;            // minus the slope of the cubic at the next texel: Catmull and Rom's is .5
const float HISTORY_TOLERANCE = 0.02;    // of a distance: nearer ones are of one surface

vec2 pixelNdc(ivec2 p)
{
    return (vec2(p) + 0.5) / viewportSize * 2.0 - 1.0;
}

// 1 where a shadow catcher shows the infinitely far map: that moves as what is behind the scene does, not as the catcher.
float depthAt(ivec2 p)
{
#ifdef HAS_CATCHERS
    uint kind = uint(texelFetch(specularMap, p, 0).a * 65535.0 + 0.5);
    if (isCatcher(kindBrdf(kind), texelFetch(normalMap, p, 0).a)) return 1.0;
#endif
    return texelFetch(depthMap, p, 0).r;
}

// What is behind the scene lies at infinity where rays part.
vec3 eyeAt(ivec2 p, float depth)
{
    bool parallel = projection[3][3] != 0.0;
    if (depth >= 1.0 && !parallel) return viewRay(inverseProjection, pixelNdc(p)) * BEHIND_ALL;
    return eyeFromDepth(inverseProjection, pixelNdc(p), depth);
}

#if defined(HISTORY) && !defined(ACCUMULATED)
struct Neighbours {
    vec3 middle, extent;  // of their colours
    vec2 coverage;        // least and greatest
    vec2 depth;
    ivec2 nearest;        // pixel
};

Neighbours neighboursOf(ivec2 p)
{
    Neighbours n;
    vec3 sum = vec3(0.0);
    vec3 squares = vec3(0.0);
    n.coverage = vec2(1.0, 0.0);
    n.depth = vec2(2.0, 0.0);
    n.nearest = p;
    ivec2 last = ivec2(viewportSize) - 1;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), last);
            vec4 picture = texelFetch(displayMap, q, 0);
            vec3 c = opponentFromRgb(picture.rgb);
            sum += c;
            squares += c * c;
            n.coverage = vec2(min(n.coverage.x, picture.a), max(n.coverage.y, picture.a));
            float depth = depthAt(q);
            if (depth < n.depth.x) n.nearest = q;
            n.depth = vec2(min(n.depth.x, depth), max(n.depth.y, depth));
        }
    n.middle = sum / 9.0;
    n.extent = HISTORY_DEVIATIONS * sqrt(max(squares / 9.0 - n.middle * n.middle, vec3(0.0))) + HISTORY_STEP;
    return n;
}

// Cubic along both sides [Catmull and Rom 1974], by linear look-ups, without the four corners' small weights.
vec4 sharpHistory(vec2 uv)
{
    vec2 at = uv * viewportSize;
    vec2 centre = floor(at - 0.5) + 0.5;
    vec2 f = at - centre;
    vec2 w0 = f * (-SHARPNESS + f * (2.0 * SHARPNESS - SHARPNESS * f));
    vec2 w1 = 1.0 + f * f * (SHARPNESS - 3.0 + (2.0 - SHARPNESS) * f);
    vec2 w2 = f * (SHARPNESS + f * (3.0 - 2.0 * SHARPNESS + (SHARPNESS - 2.0) * f));
    vec2 w3 = f * f * SHARPNESS * (f - 1.0);
    vec2 w12 = w1 + w2;
    vec2 t0 = (centre - 1.0) / viewportSize;
    vec2 t12 = (centre + w2 / w12) / viewportSize;
    vec2 t3 = (centre + 2.0) / viewportSize;
    vec4 sum = textureLod(historyMap, t12, 0.0) * (w12.x * w12.y);
    sum += textureLod(historyMap, vec2(t12.x, t0.y), 0.0) * (w12.x * w0.y);
    sum += textureLod(historyMap, vec2(t0.x, t12.y), 0.0) * (w0.x * w12.y);
    sum += textureLod(historyMap, vec2(t3.x, t12.y), 0.0) * (w3.x * w12.y);
    sum += textureLod(historyMap, vec2(t12.x, t3.y), 0.0) * (w12.x * w3.y);
    return sum / (w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x));
}

// As pass/motion.frag has it.
vec4 motionOf(ivec2 p, vec3 place)
{
#ifdef MOTION
    vec4 motion = texelFetch(motionMap, p, 0);
    if (motion.w > 0.0) return motion;
#endif
    vec3 former = vec3(formerEyeFromEye * vec4(place, 1.0));
    vec4 clip = formerProjection * vec4(former, 1.0);
    return vec4(0.5 * (clip.xy / clip.w - (pixelNdc(p) - subpixel)), place.z - former.z, 0.0);
}

// Distances before the eye of what the picture before showed about a pixel: least and greatest.
vec2 formerDistances(ivec2 q)
{
    vec2 range = vec2(2.0 * BEHIND_ALL, -2.0 * BEHIND_ALL);
    ivec2 last = ivec2(viewportSize) - 1;
    const ivec2 around[5] = ivec2[5](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    for (int i = 0; i < 5; ++i) {
        float d = texelFetch(placeMap, clamp(q + around[i], ivec2(0), last), 0).r;
        range = vec2(min(range.x, d), max(range.y, d));
    }
    return range;
}
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    shown = texelFetch(displayMap, p, 0);
    float depth = depthAt(p);
    int age = 1;
#ifdef ACCUMULATED
#ifdef HISTORY
    shown = mix(texelFetch(historyMap, p, 0), shown, accumulatedShare);
#endif
    age = HISTORY_FRAMES;
#elif defined(HISTORY)
    Neighbours n = neighboursOf(p);
    vec3 nearest = eyeAt(n.nearest, n.depth.x);
    vec4 motion = motionOf(n.nearest, nearest);
    vec2 uv = (vec2(p) + 0.5) / viewportSize + motion.xy;
    bool inside = min(uv.x, uv.y) >= 0.0 && max(uv.x, uv.y) < 1.0; // of NaN: false
    ivec2 q = inside ? ivec2(uv * viewportSize) : p;

    // Nothing about the place there is where this pixel's surfaces were: they have just come into view.
    float footprint = pixelFootprint(inverseProjection, pixelNdc(n.nearest), min(n.depth.x, 0.999999), viewportSize);
    float least = motion.z - nearest.z;
    float tolerance = HISTORY_TOLERANCE * abs(least) + 2.0 * footprint;
    vec2 distances = formerDistances(q);
    float greatest = motion.z - eyeAt(p, n.depth.y).z;
    inside = inside && distances.y >= least - tolerance && distances.x <= greatest + tolerance;
    if (inside) {
        vec4 history = sharpHistory(uv);
        vec3 bounded = rgbFromOpponent(clippedToBox(opponentFromRgb(history.rgb), n.middle, n.extent));
        history = vec4(bounded, clamp(history.a, n.coverage.x, n.coverage.y));
        age = min(placeAge(texelFetch(placeMap, q, 0).r) + 1, HISTORY_FRAMES);
        shown = mix(history, shown, 1.0 / float(age));
    } else {
        shown = textureLod(displayMap, (vec2(p) + 0.5) / viewportSize + 0.5 * subpixel, 0.0);  // not shifted
    }
#endif
    place = packPlace(-eyeAt(p, depth).z, age);
}
