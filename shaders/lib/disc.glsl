// SPDX-License-Identifier: MIT
// What discs and spheres of even radiance send a surface: their form factor, the irradiance over pi at radiance 1. Local frame as
// in lib/polygon.glsl.
#ifndef DISC_GLSL
#define DISC_GLSL

#include "lib/constants.glsl"
#include "lib/polygon.glsl"
#include "lib/sun.glsl"

// A disc by its rim r(t) = center + R (cos t x + sin t y), where the centre has no share along y. Lambert's integral along it is
// that of (a + b cos t + c sin t) / (mean + swing cos t).
struct Disc {
    vec3 center;
    float squareRadius;
    float height;     // of the surface's point above its plane
    vec3 x, y;        // unit, as seen from the lit side counter-clockwise
    float tilt;       // z of the lit side's normal
    float a, b, c;
    float mean, swing;
    float nearest, farthest;  // distance of the rim's points: sqrt(mean -+ swing)
};

// w: normal of the lit side; u and v: two radii at right angles
Disc makeDisc(vec3 center, vec3 u, vec3 v, vec3 w, float squareRadius)
{
    float radius = sqrt(squareRadius);
    vec2 foot = vec2(dot(center, u), dot(center, v)) / radius;
    float shift = length(foot);
    vec2 turn = shift > 0.0 ? foot / shift : vec2(1.0, 0.0);
    Disc d;
    d.center = center;
    d.squareRadius = squareRadius;
    d.height = -dot(center, w);
    d.x = (turn.x * u + turn.y * v) / radius;
    d.y = (turn.x * v - turn.y * u) / radius;
    d.tilt = w.z;
    d.a = squareRadius * w.z;
    d.b = radius * (d.height * d.x.z + shift * w.z);
    d.c = radius * d.height * d.y.z;
    d.mean = dot(center, center) + squareRadius;
    d.swing = 2.0 * radius * shift;
    d.nearest = max(length(vec2(d.height, shift - radius)), 1e-15);
    d.farthest = length(vec2(d.height, shift + radius));
    return d;
}

// All of it is above the horizon. Written so that nothing cancels where it is small.
float wholeDisc(Disc d)
{
    float s = d.nearest * d.farthest;
    float inside = d.squareRadius - dot(d.center, d.center);
    float rest = inside > 0.0 ? s + inside : 4.0 * d.squareRadius * d.height * d.height / (s - inside);
    return d.squareRadius / (s * (s + d.mean)) * (2.0 * d.height * d.center.z - d.tilt * rest);
}

// The rim's part above the horizon: cosine and sine of where it begins and ends, and the angle between.
struct Arc {
    vec2 from;
    vec2 to;
    float angle;
};

// reach: by how much the rim rises above the centre at most
Arc arcAbove(Disc d, float reach)
{
    float radius = sqrt(d.squareRadius);
    vec2 top = vec2(d.x.z, d.y.z) * radius / reach;
    vec2 side = vec2(-top.y, top.x);
    float sine = sqrt(max((reach - d.center.z) * (reach + d.center.z), 0.0));
    float cosine = -d.center.z / reach;
    Arc arc;
    arc.from = cosine * top - sine / reach * side;
    arc.to = cosine * top + sine / reach * side;
    arc.angle = 2.0 * atan(sine, -d.center.z);
    return arc;
}

// Lambert's integral along the arc less the same over `mean`: in powers of swing / mean < 0.1, by the integrals of cos^k and
// cos^k sin.
float arcExcessByPowers(Disc d, Arc arc)
{
    float k = -d.swing / d.mean;
    float before = arc.angle;
    float moment = arc.to.y - arc.from.y;
    vec2 power = vec2(arc.from.x, arc.to.x);
    float factor = k;
    float sum = 0.0;
    for (int i = 1; i <= 12; ++i) {
        float next = (power.y * arc.to.y - power.x * arc.from.y + float(i) * before) / float(i + 1);
        power *= vec2(arc.from.x, arc.to.x);
        sum += factor * (d.a * moment + d.b * next - d.c * (power.y - power.x) / float(i + 1));
        before = moment;
        moment = next;
        factor *= k;
    }
    return sum / d.mean;
}

// atan(q tan(t/2)) less t/2, which has no jump.
float halfAngleRest(vec2 t, float q)
{
    return -atan((1.0 - q) * t.y, 1.0 + t.x + q * (1.0 - t.x));
}

// Squared distance of the rim's point at an angle by its cosine and sine.
float rimSquare(Disc d, vec2 t)
{
    return d.nearest * d.nearest + d.swing * (t.x < 0.0 ? t.y * t.y / (1.0 - t.x) : 1.0 + t.x);
}

// The same as arcExcessByPowers() in closed form.
float arcExcess(Disc d, Arc arc)
{
    float q = d.nearest / d.farthest;
    float rest = halfAngleRest(arc.to, q) - halfAngleRest(arc.from, q);
    float ones = (arc.angle + 2.0 * rest) / (d.nearest * d.farthest);
    float cosines = (arc.angle - d.mean * ones) / d.swing;
    float sines = log(rimSquare(d, arc.from) / rimSquare(d, arc.to)) / d.swing;
    vec2 change = arc.to - arc.from;
    return d.a * (ones - arc.angle / d.mean) + d.b * (cosines - change.y / d.mean) + d.c * (sines + change.x / d.mean);
}

// The horizon cuts it: the arc above and the chord along the horizon. Over `mean` both make twice the segment's area; the rest is
// smaller by a factor of the disc's size.
float cutDisc(Disc d, float reach)
{
    Arc arc = arcAbove(d, reach);
    float radius = sqrt(d.squareRadius);
    vec3 from = radius * (arc.to.x * d.x + arc.to.y * d.y);
    vec3 chord = radius * ((arc.from.x - arc.to.x) * d.x + (arc.from.y - arc.to.y) * d.y);
    vec3 c = cross(d.center + from, chord);
    float beyond = dot(d.center, from + from + chord) + dot(from, chord);
    float segment = d.a * (arc.angle - (arc.to.y * arc.from.x - arc.to.x * arc.from.y)) / d.mean;
    float rim = d.swing < 0.1 * d.mean ? arcExcessByPowers(d, arc) : arcExcess(d, arc);
    return formFactorOf(segment + rim + c.z * angleOverSine(c.z * c.z, d.mean + beyond, true, d.mean, beyond));
}

// Disc with two radii u and v at right angles, lit on the side of u x v. 0 behind that and on its plane.
float discFormFactor(vec3 center, vec3 u, vec3 v)
{
    vec3 w = cross(u, v);
    float squareRadius = length(w);
    if (dot(center, w) >= 0.0) return 0.0;
    w /= squareRadius;
    float reach = sqrt(squareRadius * (w.x * w.x + w.y * w.y));
    if (center.z <= -reach) return 0.0;
    Disc d = makeDisc(center, u, v, w, squareRadius);
    return center.z >= reach ? clamp(wholeDisc(d), 0.0, 1.0) : cutDisc(d, reach);
}

// Sphere, lit on its outside; from inside it, 1.
float sphereFormFactor(vec3 center, float radius)
{
    float square = dot(center, center);
    float rest = square - radius * radius;
    if (rest <= 0.0) return 1.0;
    float inverse = inversesqrt(square);
    return discIrradianceOverPi(center.z * inverse, radius * inverse, sqrt(rest) * inverse);
}

#endif
