#version 330 compatibility
// SPDX-License-Identifier: MIT
// Chooses virtual lights [Keller 1997]: texels of the reflective shadow maps, by the power that they reflect. A column of this target is a
// light, and pass/virtuallights.glsl says what its rows are.
// A light sends GGX's lobe, as a linearly transformed cosine. The lobe depends on two directions, to the sun or lamp and to the receiver,
// and stays the same if these change places. It is fitted for a view from the sun or lamp: one matrix serves all receivers [seed 004, 14].
// A light stands for the surface about its texel. The more the normals turn there, the wider is its lobe.
#pragma import_defines(HAS_SCENE_RAYS)

#include "lib/constants.glsl"
#include "lib/ltc.glsl"
#include "lib/sequence.glsl"
#include "pass/reflectedlights.glsl"
#ifdef HAS_SCENE_RAYS
#include "pass/scenerays.glsl"
uniform sampler2D rayNodeMap;
uniform sampler2D rayTriangleMap;
#endif

uniform sampler2D reflectedFluxMap;  // as pass/reflectivemap.frag, with mipmaps
uniform sampler2D reflectorPlaceMap;
uniform sampler2D reflectorNormalMap;
uniform sampler2D ltcTable;
uniform float reflectedRadius[MOST_REFLECTED_LIGHTS];  // of a sun, as an angle
uniform int virtualLights;       // how many there are
uniform int reflectiveColumns;  // maps along a side
uniform float reflectorLift;    // off a surface, where the coarse triangles that rays meet may lie before it

layout(location = 0) out vec4 value;

struct Choice {
    ivec2 texel;
    float probability;  // 0: nothing reflects
};

float powerOf(ivec2 texel, int level)
{
    return dot(texelFetch(reflectedFluxMap, texel, level).rgb, vec3(1.0 / 3.0));
}

// By the power, from the topmost mipmap down [Clarberg et al. 2005].
Choice chooseTexel(vec2 u)
{
    int side = textureSize(reflectedFluxMap, 0).x;
    Choice chosen = Choice(ivec2(0), 1.0);
    for (int level = int(log2(float(side)) + 0.5) - 1; level >= 0; --level) {
        ivec2 t = 2 * chosen.texel;
        float a = powerOf(t, level);
        float b = powerOf(t + ivec2(1, 0), level);
        float c = powerOf(t + ivec2(0, 1), level);
        float d = powerOf(t + ivec2(1, 1), level);
        float all = a + b + c + d;
        if (!(all > 0.0)) return Choice(ivec2(0), 0.0);
        float lower = (a + b) / all;
        bool up = u.y >= lower;
        u.y = up ? (u.y - lower) / max(1.0 - lower, 1e-20) : u.y / lower;
        float left = up ? c / (c + d) : a / (a + b);
        bool right = u.x >= left;
        u.x = right ? (u.x - left) / max(1.0 - left, 1e-20) : u.x / left;
        chosen.texel = t + ivec2(right ? 1 : 0, up ? 1 : 0);
        chosen.probability *= (up ? 1.0 - lower : lower) * (right ? 1.0 - left : left);
    }
    return chosen;
}

// The plane of the surface that the middle of the lobe meets: the light reaches nothing behind it. A vector e: a place whose offset from the
// light has a dot product with e above 1 lies behind the plane. 0 if the lobe meets nothing.
vec3 endOf(vec3 place, vec3 d)
{
#ifdef HAS_SCENE_RAYS
    SceneHit hit = sceneHit(rayNodeMap, rayTriangleMap, place + reflectorLift * d, d, MISSED, STOPS_BY_PLACE);
    if (hit.distance == MISSED) return vec3(0.0);
    vec3 n = normalize(hit.normal);
    return n / (dot(n, d) * (hit.distance + reflectorLift) - reflectorLift);
#else
    return vec3(0.0);
#endif
}

void main()
{
    int number = int(gl_FragCoord.x);
    int row = int(gl_FragCoord.y);
    value = vec4(0.0);
    Choice chosen = chooseTexel(sobolPoint(uint(number)));
    if (!(chosen.probability > 0.0)) return;
    vec4 at = texelFetch(reflectorPlaceMap, chosen.texel, 0);
    vec4 normal = texelFetch(reflectorNormalMap, chosen.texel, 0);
    ivec2 map = chosen.texel * reflectiveColumns / textureSize(reflectedFluxMap, 0).x;
    int lightNumber = map.y * reflectiveColumns + map.x;
    ReflectedLight light = reflectedLight(lightNumber, at.xyz);
    vec3 n = normalize(normal.xyz);
    float cosine = dot(n, light.direction);
    float texels = 1.0 / (chosen.probability * float(virtualLights));  // that it stands for
    float area = light.texelArea * texels / max(cosine, 0.05);
    vec3 end = endOf(at.xyz, reflect(-light.direction, n));
    // The square of alpha is twice the variance of half vectors along an axis. Of a patch that variance is a twelfth of the square by which
    // its normals turn. Twelve times that counts, so that the lobes of neighbours overlap. A sun's disc widens the lobe, too.
    float alpha = normal.a * normal.a;
    float radius = reflectedRadius[lightNumber];
    float square = alpha * alpha + at.w * texels + 0.125 * radius * radius;
    Ltc lobe = ltcOf(ltcTable, sqrt(sqrt(min(square, 1.0))), cosine);
    mat3 frame = ltcFrame(n, light.direction);
    float determinant = abs(lobe.inverse.x * lobe.inverse.w - lobe.inverse.y * lobe.inverse.z);
    vec3 flux = texelFetch(reflectedFluxMap, chosen.texel, 0).rgb * (texels * determinant * INV_PI / (1.0 - lobe.leak));
    if (row == 0) value = vec4(at.xyz, area * INV_PI);
    if (row == 1) value = vec4(-(lobe.inverse.x * frame[0] + lobe.inverse.y * frame[2]), flux.r);
    if (row == 2) value = vec4(-frame[1], flux.g);
    if (row == 3) value = vec4(-(lobe.inverse.z * frame[0] + lobe.inverse.w * frame[2]), flux.b);
    if (row == 4) value = vec4(end, lobe.inverse.z / max(lobe.inverse.x, 1e-6));
}
