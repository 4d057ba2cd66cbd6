// SPDX-License-Identifier: MIT
// The area lights, in the world about an origin.
#ifndef PASS_AREALIGHTS_GLSL
#define PASS_AREALIGHTS_GLSL
#pragma import_defines(HAS_POLYGONS, HAS_LOBES)

#include "lib/disc.glsl"
#include "lib/farlight.glsl"
#include "lib/limits.glsl"
#include "lib/ltc.glsl"
#include "lib/polygon.glsl"

uniform sampler2D areaLightMap; // AREA_LIGHT_ROWS texels above each other each: centre, the square of the radius of what holds the light;
                                // radiance, shape + 4 where both sides are lit + 8 vertices; u, number of its picture or -1; v, 1 or -1
                                // if the picture's top is at -v, of a polygon the number of its first vertex's texel, of all texels. After
                                // the lights come the vertices about the centres

// As AreaLight::Shape.
const int AREA_RECTANGLE = 0;
const int AREA_DISC = 1;
const int AREA_SPHERE = 2;
const int AREA_POLYGON = 3;

struct AreaLight {
    int shape;
    vec3 center;  // from the receiver
    vec3 u;
    vec3 v;
    vec3 radiance;
    float squareRadius;
    bool back;  // it is seen from the other side than that of u x v
    int vertices;
    int firstVertex;
    int picture;      // its layer; -1: none
    float pictureUp;  // 1 if the picture's top is at v, -1 at -v
};

vec4 areaTexel(int i, int row)
{
    int columns = textureSize(areaLightMap, 0).x;
    return texelFetch(areaLightMap, ivec2(i % columns, i / columns * AREA_LIGHT_ROWS + row), 0);
}

// The light from a point; of one that is lit on both sides, the side that is turned to it becomes that of u x v.
AreaLight areaLight(int i, vec3 point)
{
    AreaLight a;
    vec4 center = areaTexel(i, 0);
    vec4 radiance = areaTexel(i, 1);
    int code = int(radiance.w);
    a.shape = code & 3;
    a.center = center.xyz - point;
    a.radiance = radiance.rgb;
    a.squareRadius = center.w;
    vec4 u = areaTexel(i, 2);
    vec4 v = areaTexel(i, 3);
    a.u = u.xyz;
    a.v = v.xyz;
    a.picture = int(u.w);
    a.pictureUp = v.w;
    a.back = (code & 4) != 0 && dot(cross(a.u, a.v), a.center) > 0.0;
    if (a.back) {
        a.v = -a.v;
        a.pictureUp = -a.pictureUp;
    }
    a.vertices = code >> 3;
    a.firstVertex = int(v.w);
    return a;
}

// Whether a surface of that unit normal sees any of it.
bool isLitBy(AreaLight a, vec3 n)
{
    float height = dot(n, a.center);
    if (height < 0.0 && height * height >= a.squareRadius) return false;
    return a.shape == AREA_SPHERE || dot(cross(a.u, a.v), a.center) < 0.0;
}

// The solid angle of a light that is far.
float farSolidAngle(AreaLight a)
{
    float square = dot(a.center, a.center);
    if (a.shape == AREA_SPHERE) return PI * a.squareRadius / square;
    float scale = a.shape == AREA_RECTANGLE ? 4.0 : a.shape == AREA_DISC ? PI : 1.0;
    return scale * -dot(cross(a.u, a.v), a.center) * inversesqrt(square) / square;
}

// The light in the receiver's frame.
AreaLight inFrame(AreaLight a, mat3 worldFromLocal)
{
    a.center = a.center * worldFromLocal;
    a.u = a.u * worldFromLocal;
    a.v = a.v * worldFromLocal;
    return a;
}

#ifdef HAS_POLYGONS
// Vertex k as it turns seen from the lit side, in the same frame.
vec3 areaVertex(AreaLight a, int k, mat3 worldFromLocal)
{
    int i = a.back ? a.vertices - 1 - k : k;
    int columns = textureSize(areaLightMap, 0).x;
    int texel = a.firstVertex + i;
    return texelFetch(areaLightMap, ivec2(texel % columns, texel / columns), 0).xyz * worldFromLocal;
}

float polygonFormFactor(AreaLight a, mat3 worldFromLocal)
{
    PolygonSum s = polygonSum(a.center, a.squareRadius);
    for (int k = 0; k < a.vertices; ++k) s = withVertex(s, areaVertex(a, k, worldFromLocal));
    return polygonFormFactor(s);
}
#endif

// Irradiance over pi at radiance 1 of the light in the receiver's frame.
float areaFormFactor(AreaLight a, mat3 worldFromLocal)
{
#ifdef HAS_POLYGONS
    if (a.shape == AREA_POLYGON) return polygonFormFactor(a, worldFromLocal);
#endif
    if (a.shape == AREA_SPHERE) return sphereFormFactor(a.center, length(a.u));
    return a.shape == AREA_DISC ? discFormFactor(a.center, a.u, a.v) : rectangleFormFactor(a.center, a.u, a.v);
}

#ifdef HAS_LOBES
#ifdef HAS_POLYGONS
float polygonShare(AreaLight a, Ltc lobe, mat3 worldFromLocal)
{
    LtcSum s = ltcSum(lobe, a.center, a.squareRadius);
    for (int k = 0; k < a.vertices; ++k) s = withVertex(s, areaVertex(a, k, worldFromLocal));
    return ltcShare(s);
}
#endif

// The share of a lobe that the light covers.
float areaShare(AreaLight a, Ltc lobe, mat3 worldFromLocal)
{
#ifdef HAS_POLYGONS
    if (a.shape == AREA_POLYGON) return polygonShare(a, lobe, worldFromLocal);
#endif
    if (a.shape == AREA_SPHERE) return ltcSphere(lobe, a.center, length(a.u));
    return a.shape == AREA_DISC ? ltcDisc(lobe, a.center, a.u, a.v) : ltcRectangle(lobe, a.center, a.u, a.v);
}
#endif

#endif
