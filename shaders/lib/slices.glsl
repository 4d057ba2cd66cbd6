// SPDX-License-Identifier: MIT
// Which directions does the near scene block, as far as the depth buffer knows? Half planes through the view ray, slices,
// are walked outwards on the screen; each tapped surface marks the sectors of the receiver's half circle that it covers,
// bit by bit [Therrien et al. 2023]. A tap stands for the patch of surface that its interval covers, not for a point.
#ifndef SLICES_GLSL
#define SLICES_GLSL

#include "lib/constants.glsl"
#include "lib/depth.glsl"

// Slices of a pixel at most. A pass that is compiled for fewer defines it before it includes this file.
#ifndef MOST_SLICES
#define MOST_SLICES 4
#endif

// What the slices need to know of the view, and how far they look.
struct SliceView {
    mat4 projection;
    mat4 inverseProjection;
    vec2 size;        // viewport, pixels
    float radius;     // eye units
    float thickness;  // assumed depth of what the view shows, eye units
    int slices;       // 1 to MOST_SLICES
    int taps;         // of each slice and side
    int group;        // 0..15, the pixel's number in its cell: the phases of a cell lie between each other
};

// Angles lie in the slice's plane, from the direction to the eye towards `along`.
struct Slice {
    vec3 along;   // unit, across the view ray
    float tilt;   // angle of the receiver's normal
    float phase;  // of the samples in their sectors, in (0,1)
    uint bits;    // sector j of 32 is blocked
};

struct SliceReceiver {
    vec3 point;  // eye space, lifted off its surface
    vec3 normal;
    vec3 view;        // unit, towards the eye
    float footprint;  // of a pixel, eye units
};

struct Slices {
    vec3 view;
    int count;
    Slice slice[MOST_SLICES];
};

// A slice's plane about the receiver: where its normal points there, and across that to the side where angles grow.
struct SlicePlane {
    vec3 up;
    vec3 across;
};

// A surface seen on one side of a slice. low, high: the ends of the angles that it hides, as sliceTurn() gives them.
struct SliceTap {
    vec3 x;          // eye space
    vec3 normal;     // 0: the background
    float distance;  // from the receiver across the view ray
    float low;
    float high;
    bool above;
    bool marks;  // is within the radius
};

// The view ray between two taps, at which their surfaces end.
struct SliceBorder {
    float distance;  // from the receiver across the view ray
    vec3 point;
    vec3 ray;
};

// atan(t) for |t| <= 1 to 1e-5, a ten-thousandth of a sector, in a third of the built-in function's time.
float sliceArcTangent(float t)
{
    float t2 = t * t;
    return t * (0.9998660 + t2 * (-0.3302995 + t2 * (0.1801410 + t2 * (-0.0851330 + t2 * 0.0208351))));
}

// The angle of (x, y) to 1e-5.
float sliceAngle(float y, float x)
{
    float a = abs(x);
    float b = abs(y);
    float angle = sliceArcTangent(min(a, b) / max(max(a, b), 1e-30));
    if (b > a) angle = 0.5 * PI - angle;
    if (x < 0.0) angle = PI - angle;
    return y < 0.0 ? -angle : angle;
}

// The direction d in the slice's plane as a number that grows with its angle: -1 and 1 are the horizons, 0 is up. It is the place on
// the diamond |x| + |y| = 1, which costs one division. A direction below the horizon counts as the horizon of that side, -1 or 1.
float sliceTurn(SlicePlane plane, vec3 d, float side)
{
    float across = dot(d, plane.across);
    float up = dot(d, plane.up);
    return up > 0.0 ? across / (abs(across) + up) : side;
}

// The share of the half circle between the horizons, 0 to 1, at which such a number lies.
float turnPosition(float turn)
{
    float share = 0.25 + sliceArcTangent(2.0 * abs(turn) - 1.0) * INV_PI;  // of pi, to 1e-5
    return turn < 0.0 ? 0.5 - share : 0.5 + share;
}

// Bits of the sectors whose samples (j + phase) / 32 lie between two positions, whichever is the greater.
uint sliceMarks(float a, float b, float phase)
{
    int first = max(int(ceil(32.0 * max(min(a, b), 0.0) - phase)), 0);
    int last = min(int(floor(32.0 * min(max(a, b), 1.0) - phase)), 31);
    return last < first ? 0u : (0xffffffffu >> (31 + first - last)) << first;
}

// Integral of |sin t| cos(t - tilt) from 0 to t.
float sliceIntegral(float t, float tilt)
{
    return sign(t) * (0.5 * t * sin(tilt) - 0.25 * cos(2.0 * t - tilt) + 0.25 * cos(tilt));
}

// The cosine of the receiver's normal times solid angle, per radian of azimuth, in the slice between two positions.
float sliceWeight(Slice s, vec3 view, vec3 normal, float a, float b)
{
    float inPlane = length(vec2(dot(normal, view), dot(normal, s.along)));
    return inPlane * (sliceIntegral((b - 0.5) * PI + s.tilt, s.tilt) - sliceIntegral((a - 0.5) * PI + s.tilt, s.tilt));
}

// Above its own plane no surface may rise by the rounding of depth and normal: half a degree, a tenth of a sector.
bool isAbove(vec3 d, vec3 normal)
{
    float height = dot(d, normal);
    return height > 0.0 && height * height > 1e-4 * dot(d, d);
}

// Where the border's view ray meets the plane of the tapped surface; farther from the tap along the ray than their distance
// across it and a margin, shortened along the surface: pulled off it, a plane would rise above itself.
vec3 patchEnd(SliceTap tap, SliceBorder border, float margin)
{
    float reach = abs(border.distance - tap.distance) + margin;
    float c = dot(border.ray, tap.normal);
    float t = c < -1e-4 ? dot(tap.x - border.point, tap.normal) / c : 1e4 * reach;  // missed: far away
    vec3 y = border.point + t * border.ray - tap.x;
    return tap.x + min(reach / max(abs(dot(y, border.ray)), 1e-30), 1.0) * y;
}

// Two surfaces that meet in a convex edge end there: a patch of x towards `end` is cut by the plane of its neighbour. Else
// each would overhang the edge, never fall short of it, and every ridge would be too high.
vec3 cutAtEdge(vec3 x, vec3 end, SliceTap neighbour)
{
    float from = dot(x - neighbour.x, neighbour.normal);
    float to = dot(end - neighbour.x, neighbour.normal);
    bool edge = from < -0.01 * length(x - neighbour.x) && to > 0.0;
    return edge ? x + from / (from - to) * (end - x) : end;
}

SliceTap widened(SliceTap tap, float turn)
{
    tap.low = min(tap.low, turn);
    tap.high = max(tap.high, turn);
    return tap;
}

// Up to the border to its neighbour; what is below the receiver hides as much as its horizon, side.
SliceTap widenedToBorder(SliceReceiver r, SlicePlane plane, float side, SliceTap tap, SliceBorder border, SliceTap neighbour)
{
    vec3 d = cutAtEdge(tap.x, patchEnd(tap, border, 0.5 * r.footprint), neighbour) - r.point;
    return widened(tap, isAbove(d, r.normal) ? sliceTurn(plane, d, side) : side);
}

uint tapBits(SliceTap tap, float phase)
{
    if (!tap.marks) return 0u;
    return sliceMarks(turnPosition(tap.low), turnPosition(tap.high), phase);
}

// Distance of tap j from the receiver, or with a half taken off j, of the border to its neighbour: denser near the
// receiver, no two taps on one pixel.
float tapDistance(SliceView v, float footprint, float j, float phase)
{
    float u = max(j + phase, 0.0) / float(v.taps);
    return max(v.radius * u * u, (1.0 + 0.5 * j) * footprint);
}

SliceTap noTap()
{
    SliceTap t;
    t.x = vec3(0.0);
    t.normal = vec3(0.0);
    t.distance = 0.0;
    t.low = 0.0;
    t.high = 0.0;
    t.above = false;
    t.marks = false;
    return t;
}

// The surface in that pixel, known at its centre, and the slab that reaches from it away from the eye along ray.
SliceTap tapAt(sampler2D depthMap, sampler2D normalMap, SliceView v, SliceReceiver r, SlicePlane plane, float side, ivec2 pixel, vec3 ray)
{
    SliceTap t = noTap();
    float depth = texelFetch(depthMap, pixel, 0).x;
    if (depth >= 1.0) return t;
    t.x = eyeFromDepth(v.inverseProjection, (vec2(pixel) + 0.5) / v.size * 2.0 - 1.0, depth);
    t.normal = vec3(texelFetch(normalMap, pixel, 0)) * 2.0 - 1.0;
    vec3 d = t.x - r.point;
    t.above = isAbove(d, r.normal);
    t.marks = dot(d, d) <= v.radius * v.radius;
    t.low = t.above ? sliceTurn(plane, d, side) : side;
    t.high = t.low;
    if (t.above) t = widened(t, sliceTurn(plane, d + v.thickness * ray, side));
    return t;
}

SliceBorder borderAt(SliceView v, SliceReceiver r, Slice s, float side, float distance)
{
    SliceBorder border;
    border.distance = distance;
    border.point = r.point + side * distance * s.along;
    border.ray = viewRayAt(v.inverseProjection, border.point);
    return border;
}

// What is blocked on one side of a slice, which ends at the border of the view. phase in (0,1) shifts the taps.
uint sideBits(sampler2D depthMap, sampler2D normalMap, SliceView v, SliceReceiver r, Slice s, float side, float phase)
{
    vec4 clip = v.projection * vec4(r.point, 1.0);
    vec4 clipStep = v.projection * vec4(side * s.along, 0.0);
    SlicePlane plane;
    plane.up = cos(s.tilt) * r.view + sin(s.tilt) * s.along;
    plane.across = cos(s.tilt) * s.along - sin(s.tilt) * r.view;
    uint bits = 0u;
    SliceTap former = noTap();
    int j = 0;
    bool inside = true;
    do {
        float distance = tapDistance(v, r.footprint, float(j), phase);
        vec4 c = clip + distance * clipStep;
        inside = c.w > 0.0 && abs(c.x) < c.w && abs(c.y) < c.w;
        if (inside) {
            SliceBorder border = borderAt(v, r, s, side, tapDistance(v, r.footprint, float(j) - 0.5, phase));
            ivec2 pixel = ivec2((0.5 * vec2(c) / c.w + 0.5) * v.size);
            SliceTap tap = tapAt(depthMap, normalMap, v, r, plane, side, pixel, border.ray);
            tap.distance = distance;
            bits |= tapBits(widenedToBorder(r, plane, side, former, border, tap), s.phase);
            former = widenedToBorder(r, plane, side, tap, border, former);
            ++j;
        }
    } while (inside && j < v.taps);
    SliceBorder end = borderAt(v, r, s, side, tapDistance(v, r.footprint, float(j) - 0.5, phase));
    return bits | tapBits(widenedToBorder(r, plane, side, former, end, noTap()), s.phase);
}

// The blocked sectors around the eye point p with unit normal n. bias [eye units] lifts it off its surface and must cover
// the rounding of the depth buffer; footprint is that of its pixel. normalMap holds n/2 + 1/2.
Slices slicesOf(sampler2D depthMap, sampler2D normalMap, SliceView v, vec3 p, vec3 n, float bias, float footprint)
{
    SliceReceiver r;
    r.point = p + bias * n;
    r.normal = n;
    r.view = -viewRayAt(v.inverseProjection, r.point);
    r.footprint = footprint;
    Slices result;
    result.view = r.view;
    result.count = v.slices;
    vec3 right = normalize(vec3(1.0, 0.0, 0.0) - r.view.x * r.view);
    vec3 up = cross(r.view, right);
    int i = 0;
    do {
        float azimuth = PI * (float(i) + (float(v.group) + 0.5) / 16.0) / float(v.slices);
        int phase = 7 * v.group + 5 * i + 3;
        Slice s;
        s.along = cos(azimuth) * right + sin(azimuth) * up;
        s.tilt = sliceAngle(dot(n, s.along), dot(n, r.view));
        s.phase = (float((11 * v.group + 3 * i) & 15) + 0.5) / 16.0;
        s.bits = sideBits(depthMap, normalMap, v, r, s, -1.0, (float(phase & 15) + 0.5) / 16.0) |
                 sideBits(depthMap, normalMap, v, r, s, 1.0, (float((phase + 8) & 15) + 0.5) / 16.0);
        result.slice[i] = s;
    } while (++i < v.slices);
    return result;
}

// The same in another frame.
Slices rotated(mat3 m, Slices r)
{
    r.view = m * r.view;
    for (int i = 0; i < MOST_SLICES; ++i) r.slice[i].along = m * r.slice[i].along;
    return r;
}

// Is the unit eye direction l, above the receiver's horizon, blocked? It takes the sector of its angle from the view
// direction, in the slice nearest in azimuth.
bool sliceBlocks(Slices r, vec3 l)
{
    Slice s = r.slice[0];
    float along = dot(l, s.along);
    for (int i = 1; i < MOST_SLICES; ++i) {
        float c = i < r.count ? dot(l, r.slice[i].along) : 0.0;
        if (abs(c) > abs(along)) {
            s = r.slice[i];
            along = c;
        }
    }
    float c = dot(l, r.view);
    float angle = sliceAngle(sqrt(max(1.0 - c * c, 0.0)), c) * (along < 0.0 ? -1.0 : 1.0);
    float position = (angle - s.tilt) * INV_PI + 0.5;
    int sector = clamp(int(floor(32.0 * position - s.phase + 0.5)), 0, 31);
    return ((s.bits >> sector) & 1u) != 0u;
}

#endif
