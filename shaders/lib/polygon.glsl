// SPDX-License-Identifier: MIT
// What polygons of even radiance send a surface [Lambert 1760]: their form factor, the irradiance over pi at radiance 1. Local
// frame: the surface's point is the origin, its normal +Z. Points of a light are given from its centre, and the centre from the
// origin: vertices that were rounded far away would cost small lights their digits.
#ifndef POLYGON_GLSL
#define POLYGON_GLSL

#include "lib/constants.glsl"

const int MOST_POLYGON_VERTICES = 32;

// atan(t) / t - 1, t^2 < 0.04.
float arcTangentRest(float t2)
{
    return -t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0 -
           t2 * (1.0 / 11.0 - t2 * (1.0 / 13.0 - t2 * (1.0 / 15.0 - t2 / 17.0)))))));
}

// The angle between two vectors over the length of their cross product, less 1 / square where `isFar`. c2: that length squared;
// along: their dot product; beyond: that less `square`.
float angleOverSine(float c2, float along, bool isFar, float square, float beyond)
{
    if (along > 0.0 && c2 < 0.04 * along * along) {
        float rest = arcTangentRest(c2 / (along * along));
        return isFar ? (rest * square - beyond) / (square * along) : (1.0 + rest) / along;
    }
    float sine = sqrt(c2);
    return sine > 0.0 ? atan(sine, along) / sine - (isFar ? 1.0 / square : 0.0) : 0.0;
}

// A light's centre, seen from the surface. Lambert's sum takes angle / |c| times c = a x b for each edge from a to b. Where the
// light is small beside its distance, all but a share of the order of its size cancels: there the sum is taken less c over the
// centre's squared distance, which is known for the whole loop [area-lights.md 4].
struct PolygonCenter {
    vec3 position;
    float square;  // of its distance
    bool isFar;
};

// squareRadius: about the centre, of the circle that holds the light or, of rectangles, half of that.
PolygonCenter polygonCenter(vec3 position, float squareRadius)
{
    PolygonCenter center;
    center.position = position;
    center.square = dot(position, position);
    center.isFar = squareRadius < 0.04 * center.square;
    return center;
}

// What an edge adds to the loop's sum.
float edgeTerm(PolygonCenter center, vec3 from, vec3 edge)
{
    vec3 a = center.position + from;
    vec3 c = cross(a, edge);
    float beyond = dot(center.position, from + from + edge) + dot(from, from + edge);
    float along = center.isFar ? center.square + beyond : dot(a, a + edge);
    float known = center.isFar ? (from.x * edge.y - from.y * edge.x) / center.square : 0.0;
    return c.z * angleOverSine(dot(c, c), along, center.isFar, center.square, beyond) + known;
}

float formFactorOf(float sum)
{
    return clamp(-0.5 * INV_PI * sum, 0.0, 1.0);
}

// The sum over a loop of vertices that come one by one.
struct EdgeSum {
    float sum;
    vec3 first;
    vec3 last;
    bool begun;
};

EdgeSum noEdges()
{
    EdgeSum s;
    s.sum = 0.0;
    s.first = vec3(0.0);
    s.last = vec3(0.0);
    s.begun = false;
    return s;
}

EdgeSum withVertex(EdgeSum s, PolygonCenter center, vec3 vertex)
{
    if (s.begun)
        s.sum += edgeTerm(center, s.last, vertex - s.last);
    else
        s.first = vertex;
    s.begun = true;
    s.last = vertex;
    return s;
}

float closedSum(EdgeSum s, PolygonCenter center)
{
    return s.sum + edgeTerm(center, s.last, s.first - s.last);
}

// Where an edge meets a plane through the origin; by the heights of both ends above that.
vec3 crossing(vec3 from, vec3 to, float fromHeight, float toHeight)
{
    return from + (fromHeight / (fromHeight - toHeight)) * (to - from);
}

// The part of a polygon above the horizon, whose vertices come one by one [Sutherland, Hodgman 1974]. The edges that close it along
// the horizon come of themselves.
struct PolygonSum {
    PolygonCenter center;
    EdgeSum above;
    vec3 first;
    vec3 last;
    bool begun;
};

// squareRadius: of the circle about the centre that holds the vertices
PolygonSum polygonSum(vec3 center, float squareRadius)
{
    PolygonSum s;
    s.center = polygonCenter(center, squareRadius);
    s.above = noEdges();
    s.first = vec3(0.0);
    s.last = vec3(0.0);
    s.begun = false;
    return s;
}

EdgeSum withCrossing(EdgeSum above, PolygonCenter center, vec3 from, vec3 to)
{
    float a = center.position.z + from.z;
    float b = center.position.z + to.z;
    if ((a > 0.0) == (b > 0.0)) return above;
    return withVertex(above, center, crossing(from, to, a, b));
}

// vertex: from the centre. They are counter-clockwise seen from the lit side.
PolygonSum withVertex(PolygonSum s, vec3 vertex)
{
    if (s.begun)
        s.above = withCrossing(s.above, s.center, s.last, vertex);
    else
        s.first = vertex;
    s.begun = true;
    s.last = vertex;
    if (s.center.position.z + vertex.z > 0.0) s.above = withVertex(s.above, s.center, vertex);
    return s;
}

// The form factor, once all vertices came; concave ones count as they should. From behind the lit side it is 0 up to rounding: who
// needs 0 asks for the side.
float polygonFormFactor(PolygonSum s)
{
    return formFactorOf(closedSum(withCrossing(s.above, s.center, s.last, s.first), s.center));
}

// Corner 0 to 3 of the parallelogram of half axes u and v, counter-clockwise seen from the side of u x v.
vec3 rectangleCorner(vec3 u, vec3 v, int i)
{
    return (i == 0 || i == 3 ? u : -u) + (i < 2 ? v : -v);
}

// Lambert's sum over the whole of it: the light's own edges.
float rectangleSum(PolygonCenter center, vec3 u, vec3 v)
{
    return edgeTerm(center, u + v, -u - u) + edgeTerm(center, v - u, -v - v) + edgeTerm(center, -u - v, u + u) +
           edgeTerm(center, u - v, v + v);
}

// Whether the surface sees the lit side, that of u x v, of a flat light with that centre.
bool isLitSide(vec3 center, vec3 u, vec3 v)
{
    return dot(center, cross(u, v)) < 0.0;
}

// Parallelogram center + a u + b v, a and b in [-1,1], lit on the side of u x v. 0 behind that and on its plane.
float rectangleFormFactor(vec3 center, vec3 u, vec3 v)
{
    float reach = abs(u.z) + abs(v.z);
    if (center.z <= -reach || !isLitSide(center, u, v)) return 0.0;
    float squareRadius = dot(u, u) + dot(v, v);
    if (center.z >= reach) return formFactorOf(rectangleSum(polygonCenter(center, squareRadius), u, v));
    PolygonSum s = polygonSum(center, squareRadius);
    for (int i = 0; i < 4; ++i) s = withVertex(s, rectangleCorner(u, v, i));
    return polygonFormFactor(s);
}

#endif
