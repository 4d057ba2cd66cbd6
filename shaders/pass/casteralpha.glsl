// SPDX-License-Identifier: MIT
// How much a caster stops of the light: of leaves and grilles it is in the texture.
#ifndef CASTERALPHA_GLSL
#define CASTERALPHA_GLSL
#pragma import_defines(CASTER_ALPHA, CASTER_MASK, NO_TEXTURE, TEXTURE_REPLACE, VERTEX_COLOR)

#include "pass/mask.glsl"

#if defined(CASTER_ALPHA) && !defined(NO_TEXTURE)
uniform sampler2D baseColorMap;
#endif
in vec4 vertexColor;
in vec2 textureCoordinate;

float casterAlpha()
{
#ifdef CASTER_ALPHA
    float alpha = gl_FrontMaterial.diffuse.a;
#ifdef VERTEX_COLOR
    alpha = vertexColor.a;
#endif
#ifndef NO_TEXTURE
    vec4 texel = texture(baseColorMap, textureCoordinate);
#if defined(CASTER_MASK)
    if (maskIsOpen(texel)) discard;
    alpha = 1.0;
#elif defined(TEXTURE_REPLACE)
    alpha = texel.a;
#else
    alpha *= texel.a;
#endif
#endif
    return alpha;
#else
    return 1.0;
#endif
}

#endif
