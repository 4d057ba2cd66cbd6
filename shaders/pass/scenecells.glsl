// SPDX-License-Identifier: MIT
// What a ray sees where it meets a surface: the light there is that of the cells about the place [pass/surfacecells.frag].
#ifndef SCENECELLS_GLSL
#define SCENECELLS_GLSL

#include "pass/radiancescale.glsl"
#include "pass/tracedscene.glsl"

uniform sampler2D cellLightMap;  // facings side by side, of each the cells; layers one over the other
uniform vec3 cellsLow;
uniform float cellWidth;
uniform ivec3 cellCount;

// In a layer of cells, between the four about a place.
vec4 layerLight(int facing, int layer, vec2 at)
{
    vec2 corner = vec2(facing * cellCount.x, layer * cellCount.y);
    return textureLod(cellLightMap, (corner + clamp(at, vec2(0.5), vec2(cellCount.xy) - 0.5)) / vec2(textureSize(cellLightMap, 0)), 0.0);
}

// What a white surface sends at a place, times how sure that is, in units of the map's mean. n: of unit length.
vec4 lightAt(vec3 place, vec3 n)
{
    vec3 at = (place - cellsLow) / cellWidth;
    float z = clamp(at.z - 0.5, 0.0, float(cellCount.z) - 1.0);
    int layer = min(int(z), max(cellCount.z - 2, 0));
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 3; ++k) {
        int facing = 2 * k + (n[k] > 0.0 ? 1 : 0);
        vec4 below = layerLight(facing, layer, at.xy);
        vec4 above = layerLight(facing, min(layer + 1, cellCount.z - 1), at.xy);
        sum += n[k] * n[k] * mix(below, above, z - float(layer));
    }
    return sum;
}

// Radiance of what is met at that place, times the share of it that is known; that share.
vec4 sceneRadiance(SceneHit hit, vec3 place)
{
    vec4 light = lightAt(place, normalize(hit.normal));
    float sure = smoothstep(0.0, 0.1, light.a);
    return sure * vec4(radianceScale * tracedReflectance(hit) * light.rgb / max(light.a, 1e-20) + tracedEmission(hit), 1.0);
}

#endif
