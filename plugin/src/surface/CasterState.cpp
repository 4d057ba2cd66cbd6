// SPDX-License-Identifier: MIT
#include "surface/CasterState.h"

#include <osg/AlphaFunc>

namespace osgEnvLight
{

void CasterState::merge(const osg::StateSet& s)
{
    SentLightState::merge(s);
    _alphaTest.merge(s.getMode(GL_ALPHA_TEST));
    _alphaFunction.merge(s.getAttributePair(osg::StateAttribute::ALPHAFUNC));
}

unsigned CasterState::flags(const osg::Geometry& geometry) const
{
    unsigned bits = 0;
    if (blended(&geometry)) bits |= BLENDED;
    if (textureMode() == TEXTURE_REPLACES) bits |= TEXTURE_REPLACES_ALPHA;
    if (vertexColored()) bits |= COLORED_VERTICES;
    return bits;
}

CasterState::Key CasterState::key(const osg::Geometry& geometry) const
{
    if (const TextureUnit* unit = mask(&geometry))
        return {unit->texture.attribute, unit->matrix.attribute, nullptr, nullptr, MASKED};
    const bool tested = _alphaTest.on;
    const osg::Texture* alpha = textureMode() == TEXTURE_DECAL ? nullptr : texture();  // a decal keeps the alpha below it
    return {alpha, alpha ? firstMatrix() : nullptr, tested ? _alphaFunction.attribute : nullptr, osgMaterial(), flags(geometry)};
}

osg::ref_ptr<osg::StateSet> CasterState::makeStateSet(const osg::Geometry& geometry) const
{
    const auto [texture, matrix, alphaFunction, material, flags] = key(geometry);
    const auto take = [](const osg::StateAttribute* a) { return const_cast<osg::StateAttribute*>(a); };
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    s->setDefine("CASTER_ALPHA");
    if (texture) {
        s->setTextureAttributeAndModes(0, take(texture));
        if (matrix) s->setTextureAttribute(0, take(matrix));
    } else {
        s->setDefine("NO_TEXTURE");
    }
    if (alphaFunction) s->setAttributeAndModes(take(alphaFunction));
    if (material) s->setAttribute(take(material));
    if (flags & BLENDED) s->setDefine("CASTER_BLENDED");
    if (flags & TEXTURE_REPLACES_ALPHA) s->setDefine("TEXTURE_REPLACE");
    if (flags & MASKED) s->setDefine("CASTER_MASK");
    if (flags & COLORED_VERTICES) s->setDefine("VERTEX_COLOR");
    return s;
}

}  // namespace osgEnvLight
