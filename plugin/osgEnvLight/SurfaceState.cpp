// SPDX-License-Identifier: MIT
#include <osgEnvLight/SurfaceState>

#include <osgEnvLight/Material>

#include <osg/Depth>
#include <osg/TexEnv>
#include <osg/TexGen>

namespace osgEnvLight
{

const char* const SurfaceState::gbufferDefine = "OSGENVLIGHT_GBUFFER";

bool SurfaceState::wins(unsigned newFlags, unsigned oldFlags)
{
    return !(oldFlags & osg::StateAttribute::OVERRIDE) || (newFlags & osg::StateAttribute::PROTECTED);
}

void SurfaceState::Mode::merge(osg::StateAttribute::GLModeValue value)
{
    if ((value & osg::StateAttribute::INHERIT) || !wins(value, flags)) return;
    on = (value & osg::StateAttribute::ON) != 0;
    flags = value;
}

void SurfaceState::Attribute::merge(const osg::StateSet::RefAttributePair* pair)
{
    if (!pair || !wins(pair->second, flags)) return;
    attribute = pair->first.get();
    flags = pair->second;
}

void SurfaceState::merge(const osg::StateSet& s)
{
    _lighting.merge(s.getMode(GL_LIGHTING));
    _blending.merge(s.getMode(GL_BLEND));
    _depthTest.merge(s.getMode(GL_DEPTH_TEST));
    _material.merge(s.getAttributePair(osg::StateAttribute::MATERIAL));
    _depth.merge(s.getAttributePair(osg::StateAttribute::DEPTH));
    if (!s.getTextureModeList().empty()) {
        _texturing.merge(s.getTextureMode(0, GL_TEXTURE_2D));
        _texGen.merge(s.getTextureMode(0, GL_TEXTURE_GEN_S));
    }
    if (!s.getTextureAttributeList().empty()) {
        _texture.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXTURE));
        _texEnv.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXENV));
        _texGenMode.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXGEN));
    }
    if (s.getAttribute(osg::StateAttribute::PROGRAM)) _ownProgram = !s.getDefinePair(gbufferDefine);
    if (!s.getUniformList().empty()) _brdf = Material::brdfOf(s, _brdf);
}

const osg::Texture* SurfaceState::texture() const
{
    return _texturing.on && !paintedReflection() ? dynamic_cast<const osg::Texture*>(_texture.attribute) : nullptr;
}

bool SurfaceState::paintedReflection() const
{
    const auto* gen = _texGen.on ? dynamic_cast<const osg::TexGen*>(_texGenMode.attribute) : nullptr;
    return gen && (gen->getMode() == osg::TexGen::SPHERE_MAP || gen->getMode() == osg::TexGen::REFLECTION_MAP ||
                   gen->getMode() == osg::TexGen::NORMAL_MAP);
}

bool SurfaceState::linearTexture() const
{
    const osg::Texture* t = texture();
    if (!t) return false;
    const osg::Image* image = t->getNumImages() > 0 ? t->getImage(0) : nullptr;
    const GLint format = t->getInternalFormat();
    return (image && image->getDataType() != GL_UNSIGNED_BYTE) || format == GL_SRGB8 || format == GL_SRGB8_ALPHA8;
}

bool SurfaceState::replacedByTexture() const
{
    const auto* env = texture() ? dynamic_cast<const osg::TexEnv*>(_texEnv.attribute) : nullptr;
    return env && (env->getMode() == osg::TexEnv::REPLACE || env->getMode() == osg::TexEnv::DECAL);
}

bool SurfaceState::vertexColored() const
{
    const osg::Material* m = osgMaterial();
    const bool colorMode =
        m && (m->getColorMode() == osg::Material::DIFFUSE || m->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE);
    return _brdf < 0 && (unlit() || !m || colorMode);
}

bool SurfaceState::phongMaterial() const
{
    if (_brdf >= 0 || unlit() || !osgMaterial()) return false;
    const osg::Vec4& s = osgMaterial()->getSpecular(osg::Material::FRONT);
    return s.r() > 0.0f || s.g() > 0.0f || s.b() > 0.0f;
}

bool SurfaceState::translucent() const
{
    const auto* t = _texturing.on ? dynamic_cast<const osg::Texture*>(_texture.attribute) : nullptr;
    if (t && t->getNumImages() > 0 && t->getImage(0) && t->getImage(0)->isImageTranslucent()) return true;
    return osgMaterial() && osgMaterial()->getDiffuse(osg::Material::FRONT).a() < 1.0f;
}

bool SurfaceState::depthWritten() const
{
    const auto* depth = static_cast<const osg::Depth*>(_depth.attribute);
    return !depth || depth->getWriteMask();
}

bool SurfaceState::drawnForward() const
{
    return _ownProgram || !depthTested() || !depthWritten() || blended();
}

}  // namespace osgEnvLight
