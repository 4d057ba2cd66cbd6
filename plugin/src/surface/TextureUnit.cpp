// SPDX-License-Identifier: MIT
#include "surface/TextureUnit.h"

#include "surface/SurfaceFacts.h"

#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TextureRectangle>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

using namespace limits;
using Combine = osg::TexEnvCombine;

const GLenum targets[] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE};

TextureStage stageOf(const osg::TexEnv& env)
{
    switch (env.getMode()) {
        case osg::TexEnv::REPLACE:
            return {STAGE_REPLACE};
        case osg::TexEnv::DECAL:
            return {STAGE_DECAL};
        case osg::TexEnv::BLEND:
            return {STAGE_BLEND};
        case osg::TexEnv::ADD:
            return {STAGE_ADD};
        default:
            return {STAGE_MODULATE};
    }
}

// The forms of GL_COMBINE that join the texture with the colour below, and a normal map's product with a light's direction.
TextureStage stageOf(const Combine& c, bool first)
{
    const auto isBelow = [&](GLint source) { return source == Combine::PREVIOUS || (first && source == Combine::PRIMARY_COLOR); };
    const GLint s0 = c.getSource0_RGB(), s1 = c.getSource1_RGB();
    const GLint combine = c.getCombine_RGB();
    if (combine == Combine::DOT3_RGB || combine == Combine::DOT3_RGBA)
        return {s0 == Combine::TEXTURE || s1 == Combine::TEXTURE ? STAGE_NORMALS : STAGE_OTHER};
    if (c.getOperand0_RGB() != Combine::SRC_COLOR) return {STAGE_OTHER};
    if (combine == Combine::REPLACE) return {s0 == Combine::TEXTURE ? STAGE_REPLACE : STAGE_OTHER, c.getScale_RGB()};
    if (c.getOperand1_RGB() != Combine::SRC_COLOR) return {STAGE_OTHER};
    if (combine == Combine::INTERPOLATE) {
        const bool byItsAlpha = c.getSource2_RGB() == Combine::TEXTURE && c.getOperand2_RGB() == Combine::SRC_ALPHA;
        return {byItsAlpha && s0 == Combine::TEXTURE && isBelow(s1) ? STAGE_DECAL : STAGE_OTHER, c.getScale_RGB()};
    }
    const bool both = (s0 == Combine::TEXTURE && isBelow(s1)) || (s1 == Combine::TEXTURE && isBelow(s0));
    if (!both) return {STAGE_OTHER};
    switch (combine) {
        case Combine::MODULATE:
            return {STAGE_MODULATE, c.getScale_RGB()};
        case Combine::ADD:
            return {STAGE_ADD, c.getScale_RGB()};
        case Combine::ADD_SIGNED:
            return {STAGE_ADD_SIGNED, c.getScale_RGB()};
        default:
            return {STAGE_OTHER};
    }
}

// A shadow map, as osgShadow has them.
bool holdsDepth(const osg::Texture& t)
{
    if (t.getShadowComparison()) return true;
    switch (t.getInternalFormat()) {
        case GL_DEPTH_COMPONENT:
        case GL_DEPTH_COMPONENT16:
        case GL_DEPTH_COMPONENT24:
        case GL_DEPTH_COMPONENT32:
        case GL_DEPTH_COMPONENT32F:
            return true;
        default:
            return false;
    }
}

}  // namespace

void TextureUnit::mergeMode(osg::StateAttribute::GLMode mode, osg::StateAttribute::GLModeValue value)
{
    if (mode >= GL_TEXTURE_GEN_S && mode <= GL_TEXTURE_GEN_Q) texGen[mode - GL_TEXTURE_GEN_S].merge(value);
    if (std::find(std::begin(targets), std::end(targets), mode) == std::end(targets)) return;
    (mode == GL_TEXTURE_2D ? texturing : otherTarget).merge(value);
}

void TextureUnit::mergeAttribute(osg::StateAttribute::Type type, const osg::StateSet::RefAttributePair& pair)
{
    if (type == osg::StateAttribute::TEXTURE) texture.merge(pair);
    if (type == osg::StateAttribute::TEXENV) texEnv.merge(pair);
    if (type == osg::StateAttribute::TEXGEN) texGenMode.merge(pair);
    if (type == osg::StateAttribute::TEXMAT) matrix.merge(pair);
}

bool TextureUnit::hasTexels() const
{
    const auto* t = texturing.on || otherTarget.on ? texture.as<osg::Texture>() : nullptr;
    return t && SurfaceFacts::hasTexels(*t);
}

bool TextureUnit::generatesLinear() const
{
    if (!generates()) return true;
    const auto* gen = texGenMode.as<osg::TexGen>();
    const bool linear = !gen || gen->getMode() == osg::TexGen::OBJECT_LINEAR || gen->getMode() == osg::TexGen::EYE_LINEAR;
    return linear && texGen[0].on && texGen[1].on;
}

int TextureUnit::coordinates() const
{
    if (!generates()) return STAGE_GIVEN;
    const auto* gen = texGenMode.as<osg::TexGen>();
    const int planes = gen && gen->getMode() == osg::TexGen::OBJECT_LINEAR ? STAGE_OF_OBJECT : STAGE_OF_EYE;
    return planes + (texGen[3].on ? STAGE_PROJECTED : 0);
}

TextureStage TextureUnit::stage(bool first) const
{
    if (!hasTexels()) return {};
    const auto& t = *texture.as<osg::Texture>();
    if (t.getTextureTarget() != GL_TEXTURE_2D || holdsDepth(t)) return {STAGE_OTHER};
    if (!texEnv.attribute) return {STAGE_MODULATE};
    if (const auto* env = texEnv.as<osg::TexEnv>()) return stageOf(*env);
    const auto* combine = texEnv.as<Combine>();
    return combine ? stageOf(*combine, first) : TextureStage{STAGE_OTHER};
}

}  // namespace osgEnvLight
