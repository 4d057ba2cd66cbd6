// SPDX-License-Identifier: MIT
// What the texture units of fixed-function state say of a surface.
#include "surface/SurfaceState.h"

#include <osg/TexEnv>
#include <osg/TexGen>

#include <algorithm>

namespace osgEnvLight
{

void SurfaceState::mergeTextures(const osg::StateSet& s)
{
    const auto& modes = s.getTextureModeList();
    for (size_t unit = 0; unit < std::min(modes.size(), _units.size()); ++unit)
        for (const auto& [mode, value] : modes[unit]) _units[unit].mergeMode(mode, value);
    const auto& attributes = s.getTextureAttributeList();
    for (size_t unit = 0; unit < std::min(attributes.size(), _units.size()); ++unit)
        for (const auto& [key, pair] : attributes[unit]) _units[unit].mergeAttribute(key.first, pair);
    _laterUnits = false;
    for (size_t unit = 0; unit < _units.size(); ++unit) {
        _stages[unit] = _units[unit].stage(unit == 0);
        _stages[unit].unit = int(unit);
        if (unit > 0 && _stages[unit].kind != limits::STAGE_NONE) _laterUnits = true;
    }
}

const osg::Texture* SurfaceState::texture() const
{
    const TextureUnit& unit = _units[0];
    if (!unit.texturing.on || paintedReflection() || _stages[0].kind == limits::STAGE_NORMALS) return nullptr;
    if (firstIsNormalMap()) return nullptr;
    const auto* t = unit.texture.as<osg::Texture>();
    return t && SurfaceFacts::hasTexels(*t) ? t : nullptr;
}

bool SurfaceState::paintedReflection() const
{
    const auto* gen = _units[0].texGen[0].on ? _units[0].texGenMode.as<osg::TexGen>() : nullptr;
    const bool mapped = gen && (gen->getMode() == osg::TexGen::SPHERE_MAP || gen->getMode() == osg::TexGen::REFLECTION_MAP ||
                                gen->getMode() == osg::TexGen::NORMAL_MAP);
    return mapped && _units[0].hasTexels();
}

bool SurfaceState::paintedHighlight() const
{
    const auto* env = paintedReflection() ? _units[0].texEnv.as<osg::TexEnv>() : nullptr;
    return env && env->getMode() == osg::TexEnv::ADD;
}

SurfaceState::TextureMode SurfaceState::textureMode() const
{
    if (!texture()) return TEXTURE_MODULATES;
    switch (_stages[0].kind) {
        case limits::STAGE_REPLACE:
            return TEXTURE_REPLACES;
        case limits::STAGE_DECAL:
            return TEXTURE_DECAL;
        case limits::STAGE_BLEND:
            return TEXTURE_BLENDS;
        case limits::STAGE_ADD:
            return TEXTURE_ADDS;
        default:
            return TEXTURE_MODULATES;
    }
}

const TextureFacts& SurfaceState::firstFacts() const
{
    if (_firstKnown != _units[0].texture.attribute) {
        _firstKnown = _units[0].texture.attribute;
        _firstFacts = factsOf(*_units[0].texture.as<osg::Texture>());
    }
    return _firstFacts;
}

// By its texels: what has a normal map alone is no picture of one.
bool SurfaceState::firstIsNormalMap() const
{
    return _brdf < 0 && _lighting.on && _stages[0].kind == limits::STAGE_MODULATE && !_units[0].generates() &&
           firstFacts().texels == TexelKind::NORMALS;
}

bool SurfaceState::lacksCoordinates(size_t unit, const osg::Geometry* geometry) const
{
    const TextureStage& stage = _stages[unit];
    return geometry && unit > 0 && stage.kind == limits::STAGE_MODULATE && stage.scale == 1.0f && !_units[unit].generates() &&
           !geometry->getTexCoordArray(unsigned(unit));
}

// What the map of a unit without coordinates is, as a stage.
int SurfaceState::readerMap(size_t unit, const osg::Geometry& geometry) const
{
    if (!geometry.getTexCoordArray(0)) return limits::STAGE_NONE;
    switch (factsOf(*_units[unit].texture.as<osg::Texture>()).texels) {
        case TexelKind::NORMALS:
        case TexelKind::NORMALS_PERHAPS:
            return limits::STAGE_NORMALS;
        case TexelKind::MASK:
            return limits::STAGE_MASK;
        default:
            return limits::STAGE_NONE;
    }
}

SurfaceState::Stages SurfaceState::stages(const osg::Geometry* geometry) const
{
    Stages stages;
    if (_brdf >= 0) return stages;
    if (_stages[0].kind == limits::STAGE_NORMALS || firstIsNormalMap()) stages[0].kind = limits::STAGE_NORMALS;
    if (!_laterUnits) return stages;
    for (size_t unit = 1; unit < stages.size(); ++unit) {
        if (lacksCoordinates(unit, geometry)) continue;
        stages[unit] = _stages[unit];
        if (stages[unit].kind != limits::STAGE_NONE) stages[unit].coordinates = _units[unit].coordinates();
    }
    const auto isThere = [&](int kind) {
        return std::any_of(stages.begin(), stages.end(), [&](const TextureStage& s) { return s.kind == kind; });
    };
    for (size_t unit = 1; unit < fixedUnits; ++unit) {
        const int kind = lacksCoordinates(unit, geometry) ? readerMap(unit, *geometry) : limits::STAGE_NONE;
        if (kind == limits::STAGE_NONE || isThere(kind)) continue;
        const auto free =
            std::find_if(stages.begin() + 1, stages.end(), [](const TextureStage& s) { return s.kind == limits::STAGE_NONE; });
        if (free != stages.end()) *free = {kind, 1.0f, limits::STAGE_OF_FIRST, int(unit)};
    }
    return stages;
}

const TextureUnit* SurfaceState::mask(const osg::Geometry* geometry) const
{
    if (!_laterUnits) return nullptr;
    for (const TextureStage& stage : stages(geometry))
        if (stage.kind == limits::STAGE_MASK) return &_units[size_t(stage.unit)];
    return nullptr;
}

// A map of ambient light that is the image of the diffuse one says nothing new.
bool SurfaceState::leavesMapsOut(const osg::Geometry* geometry) const
{
    if (!_laterUnits || _brdf >= 0) return false;
    const size_t first = _stages[0].kind == limits::STAGE_NONE ? 0 : firstFacts().image;
    for (size_t unit = 1; unit < fixedUnits; ++unit) {
        if (!lacksCoordinates(unit, geometry) || readerMap(unit, *geometry) != limits::STAGE_NONE) continue;
        const size_t image = factsOf(*_units[unit].texture.as<osg::Texture>()).image;
        if (image == 0 || image != first) return true;
    }
    return false;
}

bool SurfaceState::bumped() const
{
    return _brdf < 0 && std::any_of(_stages.begin(), _stages.begin() + limits::STAGED_UNITS,
                                    [](const TextureStage& s) { return s.kind == limits::STAGE_NORMALS; });
}

SurfaceState::Coordinates SurfaceState::coordinates() const
{
    if (!texture()) return FROM_VERTICES;
    const int from = _units[0].coordinates() & ~limits::STAGE_PROJECTED;
    return from == limits::STAGE_GIVEN ? FROM_VERTICES : from == limits::STAGE_OF_OBJECT ? FROM_OBJECT : FROM_EYE;
}

TextureFacts SurfaceState::textureFacts() const
{
    return texture() ? firstFacts() : TextureFacts();
}

TextureFacts SurfaceState::factsOf(const osg::Texture& texture) const
{
    return _facts ? _facts->of(texture) : SurfaceFacts::measure(texture);
}

const char* SurfaceState::unsupportedTexture(const osg::Geometry* geometry) const
{
    for (size_t unit = 1; unit < _units.size(); ++unit) {
        const TextureUnit& u = _units[unit];
        const int kind = _stages[unit].kind;
        if (kind == limits::STAGE_NONE || lacksCoordinates(unit, geometry)) continue;
        if (unit >= size_t(limits::STAGED_UNITS)) return "texture units beyond the fourth";
        if (kind == limits::STAGE_OTHER) return "texture units beyond the first that are not Texture2D or combine";
        if (!u.generatesLinear()) return "texture coordinates that are generated otherwise than by planes, or in part";
        const TextureFacts facts = factsOf(*u.texture.as<osg::Texture>());
        if (facts.linear || facts.alphaOnly) return "texture units beyond the first of floats or without colours";
    }
    if (paintedReflection()) return nullptr;
    const TextureUnit& first = _units[0];
    const TextureStage stage = _stages[0];
    if (stage.kind == limits::STAGE_NONE) return nullptr;
    if (first.texture.as<osg::Texture>()->getTextureTarget() != GL_TEXTURE_2D) return "textures other than Texture2D";
    if (stage.kind == limits::STAGE_OTHER || stage.kind == limits::STAGE_ADD_SIGNED || stage.scale != 1.0f)
        return "texture environments that combine";
    if (!first.generates()) return nullptr;
    const bool linear = first.generatesLinear() && stage.kind != limits::STAGE_NORMALS;
    return linear ? nullptr : "texture coordinates that are generated otherwise than by planes, or in part";
}

}  // namespace osgEnvLight
