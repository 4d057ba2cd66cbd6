// SPDX-License-Identifier: MIT
// How much of a sun's disc a point sees: rays to points of the disc, traced through a height map that looks along the sun's
// direction. Positions are in texels of the map, which may be longer one way than the other; z, towards the sun, in lengths of
// the shorter side. A ray gains its unit of height over less than a tenth of that across.
#ifndef SUNSHADOW_GLSL
#define SUNSHADOW_GLSL

#include "lib/atlas.glsl"
#include "lib/sequence.glsl"

// Surfaces that rise by no more than this from a texel to the next are one.
#define SUN_STEEP 6.0

// Height where a map shows nothing. A receiver may lie far below what the map shows.
#define SUN_NOTHING (-1e4)

// One of a sun's maps, in a texture of several. A texel holds the height of the first surface from the sun and the one
// half-way to the second, both from 0 to 1.
struct SunMap {
    ivec2 corner;
    int size;
    float heights;     // z from height 0 to height 1
    float longer;      // side of a texel, the shorter being 1
    ivec2 wholeCorner; // of the map that shows the whole scene, which serves beyond this one
    vec2 toWhole;      // xy there = toWhole times xy here + wholeOffset
    vec2 wholeOffset;
};

// The point that looks, on a surface whose plane rises by gradient.
struct SunReceiver {
    vec3 point;
    vec2 gradient;
    float slack; // what lies no higher above the plane is the surface itself
    float body;  // and above this, something else, wherever its middle may be
};

// Ray k of count to the unit disc: count of a pixel in a ring of sectors, all radii among them; the 16 groups of a cell lie
// between each other.
vec2 sunDiscPoint(int k, int count, int group)
{
    float turn = (float(group) + 0.5) / 16.0;
    float shift = radicalInverse(uint(group)) + 0.03125;
    int ring = (int(radicalInverse(uint(k)) * float(count)) + group / 4) % count;
    float radius = sqrt((float(ring) + shift) / float(count));
    float angle = 6.28318531 * (float(k) + turn) / float(count);
    return radius * vec2(cos(angle), sin(angle));
}

// Where within a texel that ray starts: the maps' texels leave no steps.
vec2 sunTexelPoint(int k, int group)
{
    float x = float(k) * 0.75487767 + float(group) * 0.56984029;
    float y = float(k) * 0.56984029 + float(group) * 0.75487767;
    return vec2(fract(x + 0.5), fract(y + 0.5)) - 0.5;
}

bool sunWithin(SunMap m, vec2 xy)
{
    return min(xy.x, xy.y) >= 0.0 && max(xy.x, xy.y) < float(m.size);
}

// Heights of the first surface and of the middle at xy within the map, and the centre of their texel.
vec4 sunTexel(sampler2D sunMaps, SunMap m, vec2 xy)
{
    vec2 cell = floor(xy);
    vec4 heights = texelFetch(sunMaps, m.corner + ivec2(cell), 0) * m.heights;
    return vec4(heights.x, heights.y, cell + 0.5);
}

// The same at any xy.
vec4 sunSurface(sampler2D sunMaps, SunMap m, vec2 xy)
{
    vec2 cell = floor(xy);
    ivec2 corner = m.corner;
    vec2 centre = cell + 0.5;
    if (!sunWithin(m, xy)) {
        cell = floor(xy * m.toWhole + m.wholeOffset);
        corner = m.wholeCorner;
        centre = (cell + 0.5 - m.wholeOffset) / m.toWhole;
        if (!sunWithin(m, cell)) return vec4(vec2(SUN_NOTHING * m.heights), centre);
    }
    vec4 heights = texelFetch(sunMaps, corner + ivec2(cell), 0) * m.heights;
    return vec4(heights.x, heights.y, centre);
}

// Height of the receiver's own plane at the centre of a texel.
float sunPlane(SunReceiver r, vec4 surface)
{
    return r.point.z + dot(r.gradient, vec2(surface.z, surface.w) - vec2(r.point));
}

// Whether a texel's surface is another than the receiver's own. A body is another if its middle lies above the receiver's plane. Of a sheet,
// the middle is half-way to the receiver's own surface: it has to rise by half the slack only.
bool sunHides(SunReceiver r, vec4 surface)
{
    float plane = sunPlane(r, surface);
    float rise = surface.x - plane;
    return rise > r.slack && (surface.y - plane > 0.5 * r.slack || rise > r.slack + r.body);
}

// Whether a texel's surface may be the receiver's own.
bool sunMayBeOwn(SunReceiver r, vec4 surface)
{
    return abs(surface.x - sunPlane(r, surface)) <= 2.0 * r.slack;
}

// Whether the surface that hides the receiver meets the receiver's own surface in this texel, as a wall meets a floor at its foot.
// It does if three things hold. The next texel towards the receiver hides it. Both texels show one surface. The texel on the other side does
// not show the receiver's own surface, as it would in front of the wall.
bool sunMeetsOwn(sampler2D sunMaps, SunMap m, SunReceiver r, vec4 surface, vec2 towards)
{
    vec2 centre = vec2(surface.z, surface.w);
    vec4 next = sunSurface(sunMaps, m, centre + towards);
    if (!sunHides(r, next) || abs(next.x - surface.x) > SUN_STEEP * m.longer) return false;
    return !sunMayBeOwn(r, sunSurface(sunMaps, m, centre - towards));
}

// Where a ray begins: at xy, unless that texel does not show what hides the receiver, but the next one towards the receiver may. There are
// two such texels. One lies beyond the end of the receiver's surface and shows something lower, as below the foot of a wall at which a floor
// ends. In the other, the surface that hides the receiver meets the receiver's own: both have the same height.
vec2 sunStart(sampler2D sunMaps, SunMap m, SunReceiver r, vec2 xy)
{
    vec4 surface = sunSurface(sunMaps, m, xy);
    float rise = surface.x - sunPlane(r, surface);
    if (rise > 2.0 * r.slack) return xy;
    vec2 centre = vec2(surface.z, surface.w);
    vec2 towards = vec2(neighbourTowards(vec2(r.point) - centre));
    return rise < -2.0 * r.slack || sunMeetsOwn(sunMaps, m, r, surface, towards) ? centre + towards : xy;
}

bool sunAbove(SunReceiver r, vec4 surface, float height)
{
    return surface.x - r.point.z > height && sunHides(r, surface);
}

// Length on the map within which texels cannot tell two heights of a slope apart: what the ray moves, and beyond the map the
// whole scene's wider texels.
float sunGrain(SunMap m, vec2 xy, float across)
{
    return sunWithin(m, xy) ? across : max(across, max(1.0 / m.toWhole.x, 1.0 / m.toWhole.y));
}

// What a ray does with the next texel it reads.
#define SUN_MARCH 0   // the end of the interval
#define SUN_BEFORE 1  // does it meet the surface found at the interval's start?
#define SUN_AFTER 2   // or at its end?
#define SUN_PASS 3    // it was below a surface and is above one now: where does it pass through?

// Whether the ray, between low and high, may meet a surface found elsewhere: at that surface's own height.
bool sunMayMeet(SunReceiver r, vec4 surface, float low, float high)
{
    float height = surface.x - r.point.z;
    return height > low && height <= high && sunHides(r, surface);
}

// How high above the receiver a ray is blocked that begins at `from` and moves by slope for each unit of height; negative: it is not.
// The ray is followed over intervals, each longer than the last. It may miss a thing that is much thinner than the disc is wide.
// A surface found at an end of an interval blocks the ray in two cases. First, the ray meets it at the surface's own height: the
// texel below the ray at that height is looked up, twice if its surface has another height, since a slope is a row of steps.
// Second, within the interval the ray leaves the space beneath a surface: through the surface, or past its edge and above a lower
// surface that hides the receiver. A map does not show what is beneath a surface: the lower one is taken to continue there. A ray
// that leaves from beneath a single sheet is not blocked. A sheet's edge does not depend on the intervals.
// Each turn of a loop reads one texel: rays that run side by side on the GPU do not wait for one that does more.
float sunBlocker(sampler2D sunMaps, SunMap m, SunReceiver r, vec2 from, vec2 slope)
{
    float reach = m.heights - r.point.z;
    if (reach <= 0.0) return -1.0;
    float speed = length(slope);
    float across = speed * reach;
    float doublings = log2(max(across, 1.0));
    int steps = 1 + int(min(ceil(doublings / log2(1.6)), 12.0));
    float growth = exp2(doublings / float(max(steps - 1, 1)));
    float low = 0.0;
    float high = steps > 1 ? reach / across : reach;
    vec2 xy = sunStart(sunMaps, m, r, from);
    vec4 former = sunSurface(sunMaps, m, xy);
    vec4 surface = former;
    // Most rays pass everything: until something may be met, or the map ends, all there is to do is to march on.
    bool formerHides = sunHides(r, former);
    bool passes = true;
    do {
        vec2 there = xy + slope * high;
        surface = sunTexel(sunMaps, m, there);
        bool hides = sunHides(r, surface);
        float rise = surface.x - r.point.z;
        float formerRise = former.x - r.point.z;
        bool meets = hides && rise > low && rise <= high;
        meets = meets || (formerHides && formerRise > low && (formerRise <= high || !(hides && rise > high)));
        passes = !meets && sunWithin(m, there);
        if (passes) {
            former = surface;
            formerHides = hides;
            low = high;
            high *= growth;
            --steps;
        }
    } while (passes && steps > 0);
    vec4 above = former;  // of the ray's two ends in SUN_PASS: where it is above the surface
    int mode = SUN_MARCH;
    int tries = 0;
    float height = 0.0;  // at which the surface is asked, or the lower end of what is halved
    float top = 0.0;     // its upper end
    float step = 0.0;    // how far the ray moved across between two such heights
    for (int i = 0; steps > 0 && i < 128; ++i) {
        float at = mode == SUN_MARCH ? high : mode == SUN_PASS ? 0.5 * (height + top) : height;
        vec2 there = xy + slope * at;
        vec4 found = sunSurface(sunMaps, m, there);
        int next = mode;
        if (mode == SUN_MARCH) {
            surface = found;
            next = SUN_BEFORE;
            tries = 0;
        } else if (mode == SUN_PASS) {
            bool isBelow = sunAbove(r, found, at);
            if (isBelow) {
                height = at;
            } else {
                top = at;
                above = found;
            }
            if (++tries == 5) {
                if (height > 0.0 && sunHides(r, above)) return height;
                next = SUN_MARCH;
            }
        } else {
            float own = found.x - r.point.z;
            if (abs(own - height) <= SUN_STEEP * m.longer * (1.0 + sunGrain(m, there, step))) return height;
            step = speed * abs(own - height);
            height = own;
            if (++tries == 2 || !sunMayMeet(r, found, low, high)) {
                next = mode + 1;
                tries = 0;
            }
        }
        if (next == SUN_BEFORE && tries == 0) {
            height = former.x - r.point.z;
            if (!sunMayMeet(r, former, low, high)) next = SUN_AFTER;
        }
        if (next == SUN_AFTER && tries == 0) {
            height = surface.x - r.point.z;
            if (!sunMayMeet(r, surface, low, high)) next = SUN_PASS;
        }
        if ((next == SUN_BEFORE || next == SUN_AFTER) && tries == 0) step = speed * min(height - low, high - height);
        if (next == SUN_PASS && mode != SUN_PASS) {
            height = low;
            top = high;
            above = surface;
            tries = 0;
            if (!sunAbove(r, former, low) || sunAbove(r, surface, high)) next = SUN_MARCH;
        }
        if (next == SUN_MARCH) {
            former = surface;
            low = high;
            high *= growth;
            --steps;
        }
        mode = next;
    }
    return -1.0;
}

#endif
