// SPDX-License-Identifier: MIT
// How much a caster stops of the light: of leaves and grilles it is in the texture.
#ifndef CASTERALPHA_GLSL
#define CASTERALPHA_GLSL
#pragma import_defines(CASTER_ALPHA, NO_TEXTURE, TEXTURE_REPLACE, VERTEX_COLOR)

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
    float texel = texture(baseColorMap, textureCoordinate).a;
#ifdef TEXTURE_REPLACE
    alpha = texel;
#else
    alpha *= texel;
#endif
#endif
    return alpha;
#else
    return 1.0;
#endif
}

#endif
