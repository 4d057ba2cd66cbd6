// SPDX-License-Identifier: MIT
// How much of the map's light reaches surfaces that no G-buffer holds. Each pixel of a 2x2 cell looks up a quarter of the lights in
// their shadow maps, and all four pixels take the mean.
#ifndef SKYSEEN_GLSL
#define SKYSEEN_GLSL
#pragma import_defines(HAS_ATLAS)

#include "lib/frame.glsl"
#include "lib/ggx.glsl"
#include "pass/litsurface.glsl"
#ifdef HAS_ATLAS
#include "pass/atlas.glsl"
#endif

// Shares of the map's light, of all directions and of the lobe that reach the surface.
struct SkySeen {
    vec3 light;
    float ambient;
    float lobe;
};

#ifdef HAS_ATLAS
// Unit normal of the flat triangle, which is what the maps show, on the side of the surface's interpolated normal.
vec3 facetOf(Surface s)
{
    vec3 n = cross(dFdx(s.position), dFdy(s.position));
    float size = length(n);
    return size > 0.0 ? n * ((dot(n, s.normal) < 0.0 ? -1.0 : 1.0) / size) : s.normal;
}

// Mean of the 2x2 pixels that are shaded together. Which of a pair this one is, the derivative of their parities says: where they
// begin depends on the window's height.
vec4 cellMean(vec4 v, ivec2 p)
{
    vec2 parity = vec2(p);
    vec2 first = vec2((p.x == 0) == (dFdx(parity.x) > 0.0) ? 0.5 : -0.5, (p.y == 0) == (dFdy(parity.y) > 0.0) ? 0.5 : -0.5);
    vec4 row = v + first.x * dFdx(v);
    return row + first.y * dFdy(row);
}
#endif

// Narrower lobes would hold too few of the map's lights.
const float LEAST_ALPHA = 0.3;

SkySeen skySeen(Surface s)
{
#ifdef HAS_ATLAS
    vec3 point = vec3(atlasFromEye * vec4(s.position, 1.0));
    vec3 normal = mat3(atlasFromEye) * s.normal;
    vec3 facet = mat3(atlasFromEye) * facetOf(s);
    mat3 localFromEye = transpose(frameAround(s.normal));
    vec3 view = localFromEye * -s.ray;
    mat3 localFromLights = localFromEye * transpose(mat3(atlasFromEye));
    vec4 num = vec4(0.0);
    vec4 den = vec4(0.0);
    vec2 lobe = vec2(0.0);
    ivec2 p = ivec2(gl_FragCoord.xy) & 1;
    int count = textureSize(atlasLightMap, 0).x;
    for (int group = p.x + 2 * p.y; group < 16; group += 4)
        for (int i = 0; i < count; ++i) {
            AtlasLight light = atlasLight(group, i);
            float c = dot(normal, light.direction);
            if (c <= 0.0) continue;
            vec4 e = c * vec4(light.flux, light.solidAngle);
            float l = e.a * lobeShare(view, localFromLights * light.direction, max(s.roughness * s.roughness, LEAST_ALPHA));
            float seen = atlasSees(light, point, facet);
            num += seen * e;
            den += e;
            lobe += l * vec2(seen, 1.0);
        }
    num = cellMean(num, p);
    den = cellMean(den, p);
    lobe = cellMean(vec4(lobe, 0.0, 0.0), p).xy;
    // Of nothing nothing is hidden.
    vec4 share = mix(vec4(1.0), num / max(den, vec4(1e-20)), greaterThan(den, vec4(0.0)));
    return SkySeen(share.rgb, share.a, lobe.y > 0.0 ? lobe.x / lobe.y : 1.0);
#else
    return SkySeen(vec3(1.0), 1.0, 1.0);
#endif
}

#endif
