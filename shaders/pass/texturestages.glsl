// SPDX-License-Identifier: MIT
// The texture units of fixed function after the first, and normal maps in any unit [OpenGL 2.1, 3.8.13]. Like the host's own pictures,
// they add and mix display values. A stage is the unit of its number, or a map that a reader of files left in a unit further on.
#ifndef TEXTURESTAGES_GLSL
#define TEXTURESTAGES_GLSL
#pragma import_defines(TEXTURE_STAGES)

#include "lib/limits.glsl"
#include "lib/tone.glsl"
#include "pass/mask.glsl"
#include "pass/materialmaps.glsl"

#ifdef TEXTURE_STAGES
uniform int textureStages[STAGED_UNITS];    // how each unit joins
uniform float textureScales[STAGED_UNITS];
uniform sampler2D stageMaps[STAGED_UNITS];

in vec3 stageCoordinates[4];

// base: linear; texel: of display values; tint: colour of the environment.
vec4 stageColor(vec4 base, vec4 texel, int stage, float scale, vec3 tint)
{
    vec3 below = srgbEncode3(base.rgb);
    vec3 display = texel.rgb;  // as it replaces
    float alpha = base.a;
    if (stage == STAGE_MODULATE) display = below * texel.rgb;
    if (stage == STAGE_DECAL) display = mix(below, texel.rgb, texel.a);
    if (stage == STAGE_BLEND) display = mix(below, tint, texel.rgb);
    if (stage == STAGE_ADD) display = below + texel.rgb;
    if (stage == STAGE_ADD_SIGNED) display = below + texel.rgb - 0.5;
    if (stage == STAGE_MODULATE || stage == STAGE_BLEND) alpha *= texel.a;
    if (stage == STAGE_REPLACE) alpha = texel.a;
    return vec4(srgbDecode3(clamp(scale * display, 0.0, 1.0)), alpha);
}

vec4 stageTexel(int number)
{
    // Arrays of samplers take constant indices alone.
    if (number == 0) return textureProj(stageMaps[0], stageCoordinates[0]);
    if (number == 1) return textureProj(stageMaps[1], stageCoordinates[1]);
    if (number == 2) return textureProj(stageMaps[2], stageCoordinates[2]);
    return textureProj(stageMaps[3], stageCoordinates[3]);
}

vec4 stagedColor(vec4 base)
{
    for (int number = 1; number < STAGED_UNITS; ++number) {
        int stage = textureStages[number];
        if (stage == STAGE_NONE || stage == STAGE_NORMALS) continue;
        vec4 texel = stageTexel(number);
        if (stage == STAGE_MASK && maskIsOpen(texel)) discard;
        if (stage != STAGE_MASK) base = stageColor(base, texel, stage, textureScales[number], gl_TextureEnvColor[number].rgb);
    }
    return base;
}

vec3 stagedNormal(vec3 n, vec3 eye)
{
    for (int number = 0; number < STAGED_UNITS; ++number)
        if (textureStages[number] == STAGE_NORMALS) {
            vec3 coordinate = stageCoordinates[number];
            n = bentNormal(n, coordinateTangents(n, eye, coordinate.xy / coordinate.z, 1.0), stageTexel(number).xyz, 1.0);
        }
    return n;
}
#endif

#endif
