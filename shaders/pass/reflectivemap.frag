#version 330 compatibility
// SPDX-License-Identifier: MIT
// A reflective shadow map [Dachsbacher, Stamminger 2005]: what a light sees, and the power that the lobes of polished metal reflect there,
// over pi and in units of the map's mean. The power of a texel is the light's irradiance times the texel's area across the light, so the
// sum over the map does not depend on the size of texels [systems.md E17].
#pragma import_defines(CASTER_BLENDED, HAS_SCENE_LIGHTS)

#include "lib/sequence.glsl"
#include "pass/casteralpha.glsl"
#include "pass/reflectedlights.glsl"
#ifdef HAS_SCENE_LIGHTS
#include "pass/scenelights.glsl"
uniform mat4 eyeFromPlaces;
uniform float radianceScale;
#endif

uniform vec4 reflectedIrradiance[MOST_REFLECTED_LIGHTS];  // over pi, of what faces a sun; alpha: the number of the application's light, or -1
uniform int mapNumber;
uniform vec4 casterReflects;  // its lobe's share of light, its roughness

in vec3 casterPlace;
in vec3 casterNormal;

layout(location = 0) out vec4 flux;    // alpha goes out for the fixed-function alpha test
layout(location = 1) out vec4 place;   // and by how much the normal turns across a texel: the sum of squares along both directions
layout(location = 2) out vec4 normal;  // and the lobe's roughness

vec3 irradianceOverPi()
{
    vec4 sun = reflectedIrradiance[mapNumber];
#ifdef HAS_SCENE_LIGHTS
    if (sun.a >= 0.0) {
        vec3 direction;
        return sceneLightAt(int(sun.a), vec3(eyeFromPlaces * vec4(casterPlace, 1.0)), direction) / radianceScale;
    }
#endif
    return sun.rgb;
}

void main()
{
    float alpha = casterAlpha();
#ifdef CASTER_BLENDED
    if (alpha <= (float(bayer4(int(gl_FragCoord.x), int(gl_FragCoord.y))) + 0.5) / 16.0) discard;
    alpha = 1.0;
#endif
    vec3 n = normalize(casterNormal);
    vec3 across = dFdx(n);
    vec3 up = dFdy(n);
    vec3 facet = cross(dFdx(casterPlace), dFdy(casterPlace));
    ReflectedLight light = reflectedLight(mapNumber, casterPlace);
    // The side that the light sees: that of the facet, whichever way vertices and normals are given.
    if (dot(n, facet) * dot(light.direction, facet) < 0.0) n = -n;
    bool reflects = dot(n, light.direction) > 0.0 && max(casterReflects.r, max(casterReflects.g, casterReflects.b)) > 0.0;
    flux = vec4(reflects ? casterReflects.rgb * irradianceOverPi() * light.texelArea : vec3(0.0), alpha);
    place = vec4(casterPlace, dot(across, across) + dot(up, up));
    normal = vec4(n, casterReflects.a);
}
