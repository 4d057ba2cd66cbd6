// SPDX-License-Identifier: MIT
// The share of a GGX lobe that a light of even radiance covers, by linearly transformed cosines [Heitz et al. 2016]: the lobe of
// lib/ggx.glsl with F = 1, times the cosine, over its integral above the horizon, is fitted by a cosine lobe that a matrix
// stretches; the inverse takes the light to the cosine lobe, where lib/polygon.glsl has what it covers. Local frame as in
// lib/ggx.glsl, with the view in the half plane y = 0, x >= 0: ltcFrame(). Flat lights are lit on the side of u x v.
#ifndef LTC_GLSL
#define LTC_GLSL

#include "lib/constants.glsl"
#include "lib/frame.glsl"
#include "lib/polygon.glsl"

// Views that are lower are taken as if they were not.
const float LTC_LEAST_COSINE = 0.004;

struct Ltc {
    vec4 inverse;  // its x.x, x.z, z.x and z.z; y.y is 1, the rest 0
    float leak;    // share of the fitted lobe that is below the horizon, which is clipped and made up for
};

// The half space above the horizon, seen from the cosine lobe, is that about the matrix's third row, which is proportional to
// (-z.x, 0, x.x) of the inverse: 1/2 - 1/2 of its cosine to the lobe's axis is outside.
float ltcLeak(vec4 inverse)
{
    float row = sqrt(inverse.x * inverse.x + inverse.z * inverse.z);
    return 0.5 * inverse.z * inverse.z / (row * (row + inverse.x));
}

// table: LtcTable.h; cosTheta: of the view. Of a narrow lobe the first row is (c^2, s c) by the view's cosine and sine, and the
// third is proportional to alpha: the table has the first row's rest and the third over alpha, which interpolation hardly changes,
// and the highlight stays in its place.
Ltc ltcOf(sampler2D table, float roughness, float cosTheta)
{
    float c = clamp(cosTheta, LTC_LEAST_COSINE, 1.0);
    float s = sqrt(1.0 - c * c);
    float alpha = max(roughness * roughness, 1e-4);
    float side = float(textureSize(table, 0).x);
    float last = side - 1.0;
    vec2 place = vec2(atan(s, c) * 2.0 * INV_PI, clamp(roughness, 0.0, 1.0));
    vec4 rest = textureLod(table, (place * last + vec2(0.5)) / side, 0.0);
    Ltc lobe;
    lobe.inverse = vec4(c * c + rest.x, s * c + rest.y, alpha * rest.z, alpha * rest.w);
    lobe.leak = ltcLeak(lobe.inverse);
    return lobe;
}

// Columns of the frame in which lobes are kept, by the normal and the direction to the eye, both of unit length.
mat3 ltcFrame(vec3 n, vec3 v)
{
    vec3 x = v - dot(n, v) * n;
    float square = dot(x, x);
    if (square < 1e-12) return frameAround(n);  // the lobe is the same all around
    x *= inversesqrt(square);
    return mat3(x, cross(n, x), n);
}

vec3 toCosineLobe(Ltc lobe, vec3 p)
{
    return vec3(lobe.inverse.x * p.x + lobe.inverse.y * p.z, p.y, lobe.inverse.z * p.x + lobe.inverse.w * p.z);
}

// The fitted lobe's density per solid angle in the unit direction l above the horizon: of a light so small that it is the same all over it.
float ltcDensity(Ltc lobe, vec3 l)
{
    vec3 w = toCosineLobe(lobe, l);
    float square = dot(w, w);
    float determinant = abs(lobe.inverse.x * lobe.inverse.w - lobe.inverse.y * lobe.inverse.z);
    return INV_PI * max(w.z, 0.0) * determinant / (square * square * (1.0 - lobe.leak));
}

float ltcShareOf(Ltc lobe, float formFactor)
{
    return min(formFactor / (1.0 - lobe.leak), 1.0);
}

// As PolygonSum: the vertices of a polygon come one by one. Its part above the horizon goes to the cosine lobe, where its part
// above that lobe's own horizon counts.
struct LtcSum {
    Ltc lobe;
    float height;  // of the centre
    PolygonSum inside;
    vec3 first;
    vec3 last;
    bool begun;
};

// squareRadius: of the circle about the centre that holds the vertices
LtcSum ltcSum(Ltc lobe, vec3 center, float squareRadius)
{
    LtcSum s;
    s.lobe = lobe;
    s.height = center.z;
    s.inside = polygonSum(toCosineLobe(lobe, center), (1.0 + dot(lobe.inverse, lobe.inverse)) * squareRadius);
    s.first = vec3(0.0);
    s.last = vec3(0.0);
    s.begun = false;
    return s;
}

PolygonSum withLtcCrossing(LtcSum s, vec3 to)
{
    float a = s.height + s.last.z;
    float b = s.height + to.z;
    if ((a > 0.0) == (b > 0.0)) return s.inside;
    return withVertex(s.inside, toCosineLobe(s.lobe, crossing(s.last, to, a, b)));
}

// vertex: from the centre. They are counter-clockwise seen from the lit side.
LtcSum withVertex(LtcSum s, vec3 vertex)
{
    if (s.begun)
        s.inside = withLtcCrossing(s, vertex);
    else
        s.first = vertex;
    s.begun = true;
    s.last = vertex;
    if (s.height + vertex.z > 0.0) s.inside = withVertex(s.inside, toCosineLobe(s.lobe, vertex));
    return s;
}

// Once all vertices came. From behind the lit side it is 0 up to rounding.
float ltcShare(LtcSum s)
{
    return ltcShareOf(s.lobe, polygonFormFactor(withLtcCrossing(s, s.first)));
}

// Parallelogram center + a u + b v, a and b in [-1,1].
float ltcRectangle(Ltc lobe, vec3 center, vec3 u, vec3 v)
{
    float reach = abs(u.z) + abs(v.z);
    if (center.z <= -reach || !isLitSide(center, u, v)) return 0.0;
    vec3 lobeCenter = toCosineLobe(lobe, center);
    vec3 lobeU = toCosineLobe(lobe, u);
    vec3 lobeV = toCosineLobe(lobe, v);
    float lobeReach = abs(lobeU.z) + abs(lobeV.z);
    if (center.z >= reach && lobeCenter.z >= lobeReach) {
        PolygonCenter whole = polygonCenter(lobeCenter, dot(lobeU, lobeU) + dot(lobeV, lobeV));
        return ltcShareOf(lobe, formFactorOf(rectangleSum(whole, lobeU, lobeV)));
    }
    LtcSum s = ltcSum(lobe, center, dot(u, u) + dot(v, v));
    for (int i = 0; i < 4; ++i) s = withVertex(s, rectangleCorner(u, v, i));
    return ltcShare(s);
}

// Disc with two radii u and v at right angles, as a polygon.
float ltcDisc(Ltc lobe, vec3 center, vec3 u, vec3 v)
{
    float reach = 1.02 * sqrt(u.z * u.z + v.z * v.z);
    if (center.z <= -reach || !isLitSide(center, u, v)) return 0.0;
    LtcSum s = ltcSum(lobe, center, 1.05 * dot(u, u));
    // Narrow lobes show its corners. It has the disc's area.
    int vertices = length(vec2(lobe.inverse.z, lobe.inverse.w)) < 0.2 ? 32 : 16;
    float step = TWO_PI / float(vertices);
    float widen = sqrt(step / sin(step));
    for (int i = 0; i < vertices; ++i) {
        float angle = step * float(i);
        s = withVertex(s, widen * (cos(angle) * u + sin(angle) * v));
    }
    return ltcShare(s);
}

// Sphere, by the disc that its outline is; inside it, 1.
float ltcSphere(Ltc lobe, vec3 center, float radius)
{
    float square = dot(center, center);
    float rest = square - radius * radius;
    if (rest <= 0.0) return 1.0;
    vec3 axis = center * inversesqrt(square);
    mat3 frame = frameAround(-axis);
    return ltcDisc(lobe, axis * sqrt(rest), radius * frame[0], radius * frame[1]);
}

#endif
