// SPDX-License-Identifier: MIT
// What the map sends into the lobe on top of a pixel [pass/toplobe.glsl], and what the scene hides of it. In units of the map's mean.
#ifndef TOPLIGHT_GLSL
#define TOPLIGHT_GLSL

#include "pass/gbuffer.glsl"

uniform sampler2D specularTermMap;
uniform sampler2D blockedLobeMap;
#ifdef HAS_COATS
uniform sampler2D coatTermMap;
uniform sampler2D blockedCoatMap;
#endif

struct TopLight {
    vec3 specular;
    vec4 blocked;  // w: share
};

TopLight topLight(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) return TopLight(texelFetch(coatTermMap, p, 0).rgb, texelFetch(blockedCoatMap, p, 0));
#endif
    return TopLight(texelFetch(specularTermMap, p, 0).rgb, texelFetch(blockedLobeMap, p, 0));
}

#endif
