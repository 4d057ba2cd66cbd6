// SPDX-License-Identifier: MIT
#include "surface/SurfaceState.h"

#include <osgEnvLight/LightShader>
#include <osgEnvLight/SurfaceProgram>

#include "surface/MaterialMaps.h"

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/LightModel>
#include <osg/Program>
#include <osg/Texture2D>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

bool onlyPointsAndLines(const osg::Geometry& geometry)
{
    bool any = false;
    for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
        const GLenum mode = geometry.getPrimitiveSet(i)->getMode();
        const bool lines = mode == GL_LINES || mode == GL_LINE_STRIP || mode == GL_LINE_LOOP || mode == GL_LINES_ADJACENCY ||
                           mode == GL_LINE_STRIP_ADJACENCY;
        if (mode != GL_POINTS && !lines) return false;
        any = true;
    }
    return any;
}

bool sameDepthRange(const osg::Depth* a, const osg::Depth* b)
{
    const double aNear = a ? a->getZNear() : 0.0, aFar = a ? a->getZFar() : 1.0;
    const double bNear = b ? b->getZNear() : 0.0, bFar = b ? b->getZFar() : 1.0;
    return aNear == bNear && aFar == bFar;
}

// Towards the eye or away from it; 0: what keeps something else than the nearest.
int orderOf(const osg::Depth* depth)
{
    if (!depth || depth->getFunction() == osg::Depth::LESS || depth->getFunction() == osg::Depth::LEQUAL) return 1;
    return depth->getFunction() == osg::Depth::GREATER || depth->getFunction() == osg::Depth::GEQUAL ? -1 : 0;
}

bool hasLightShader(const osg::Program& program)
{
    for (unsigned i = 0; i < program.getNumShaders(); ++i)
        if (LightShader::isOne(*program.getShader(i))) return true;
    return false;
}

}  // namespace

const char* const SurfaceState::gbufferDefine = "OSGENVLIGHT_GBUFFER";

void SurfaceState::merge(const osg::StateSet& s)
{
    for (const auto& [mode, value] : s.getModeList()) mergeMode(mode, value);
    for (const auto& [key, pair] : s.getAttributeList())
        if (key.second == 0) mergeAttribute(key.first, pair);
    if (!s.getTextureModeList().empty() || !s.getTextureAttributeList().empty()) mergeTextures(s);
    if (const osg::StateAttribute* program = s.getAttribute(osg::StateAttribute::PROGRAM)) {
        const auto* own = dynamic_cast<const osg::Program*>(program);  // osgEarth's is none
        _movingProgram = own && SurfaceProgram::vertexShaderOf(*own) ? own : nullptr;
        _ownProgram = !_movingProgram && !s.getDefinePair(gbufferDefine);
        _litProgram = own && hasLightShader(*own);
    }
    if (!s.getUniformList().empty()) mergeMaps(s);
}

void SurfaceState::mergeMaps(const osg::StateSet& s)
{
    _brdf = Material::brdfOf(s, _brdf);
    if (Material::brdfOf(s, -1) >= 0) _edged = s.getUniform(MaterialMaps::edge) != nullptr;  // another BRDF has no such metal
    for (size_t i = 0; i < _mapUnits.size(); ++i)
        if (const osg::Uniform* unit = s.getUniform(MaterialMaps::samplers[i])) unit->get(_mapUnits[i]);
    if (const osg::Uniform* emission = s.getUniform(MaterialMaps::emission)) _emits = emission->get(_emission);
    if (const osg::Uniform* mode = s.getUniform(MaterialMaps::lightMode)) mode->get(_light);
    if (s.getUniform(MaterialMaps::light)) _isAreaLight = true;
    if (const osg::Uniform* catcher = s.getUniform(MaterialMaps::shadowCatcher)) catcher->get(_shadowCatcher);
    if (s.getUniform(MaterialMaps::dielectric)) _dielectric = true;
    if (const osg::Uniform* roughness = s.getUniform(MaterialMaps::diffuseRoughness)) roughness->get(_diffuseRoughness);
    if (const osg::Uniform* coat = s.getUniform(MaterialMaps::coat)) coat->get(_coat);
    if (const osg::Uniform* anisotropy = s.getUniform(MaterialMaps::anisotropy)) anisotropy->get(_anisotropy);
    if (const osg::Uniform* colors = s.getUniform(MaterialMaps::vertexColors)) colors->get(_ownVertexColors);
}

bool SurfaceState::mapped(unsigned map) const
{
    const int unit = _mapUnits[map];
    if (map >= MaterialMaps::firstOfCoat && !coated()) return false;
    if (map == MaterialMaps::ofAnisotropy && !anisotropic()) return false;
    if (_brdf < 0 || unit < 1 || unit >= int(_units.size())) return false;
    const auto* t = _units[size_t(unit)].texture.as<osg::Texture2D>();
    return t && SurfaceFacts::hasTexels(*t);
}

void SurfaceState::mergeMode(osg::StateAttribute::GLMode mode, osg::StateAttribute::GLModeValue value)
{
    switch (mode) {
        case GL_LIGHTING:
            return _lighting.merge(value);
        case GL_BLEND:
            return _blending.merge(value);
        case GL_SAMPLE_ALPHA_TO_COVERAGE:
            return _alphaToCoverage.merge(value);
        case GL_DEPTH_TEST:
            return _depthTest.merge(value);
        case GL_STENCIL_TEST:
            return _stencil.merge(value);
        case GL_SCISSOR_TEST:
            return _scissor.merge(value);
        case GL_COLOR_LOGIC_OP:
            return _logicOp.merge(value);
        case GL_FOG:
            return _fog.merge(value);
        case GL_CULL_FACE:
            return _faceCulling.merge(value);
        case GL_VERTEX_PROGRAM_ARB:
            return _vertexProgram.merge(value);
        case GL_FRAGMENT_PROGRAM_ARB:
            return _fragmentProgram.merge(value);
        default:
            if (mode >= GL_CLIP_PLANE0 && mode < GL_CLIP_PLANE0 + _clipPlanes.size())
                _clipPlanes[mode - GL_CLIP_PLANE0].merge(value);
    }
}

void SurfaceState::mergeAttribute(osg::StateAttribute::Type type, const osg::StateSet::RefAttributePair& pair)
{
    switch (type) {
        case osg::StateAttribute::MATERIAL:
            return _material.merge(pair);
        case osg::StateAttribute::DEPTH:
            return _depth.merge(pair);
        case osg::StateAttribute::BLENDFUNC:
            return _blendFunction.merge(pair);
        case osg::StateAttribute::BLENDEQUATION:
            return _blendEquation.merge(pair);
        case osg::StateAttribute::COLORMASK:
            return _colorMask.merge(pair);
        case osg::StateAttribute::LIGHTMODEL:
            return _lightModel.merge(pair);
        case osg::StateAttribute::FOG:
            return _fogAttribute.merge(pair);
        default:
            return;
    }
}

void SurfaceState::enterNode()
{
    _ownProgram = false;
    _movingProgram = nullptr;
    for (Mode* m : {&_stencil, &_scissor, &_logicOp, &_vertexProgram, &_fragmentProgram}) m->on = false;
    _colorMask.attribute = nullptr;
    _nodeDepth = _depth.as<osg::Depth>();
}

bool SurfaceState::tracksColors() const
{
    const osg::Material* m = osgMaterial();
    return !m || m->getColorMode() == osg::Material::DIFFUSE || m->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
}

bool SurfaceState::white() const
{
    return _brdf < 0 && bumped() && tracksColors();
}

bool SurfaceState::vertexColored() const
{
    if (_brdf >= 0) return _ownVertexColors;
    return unlit() || (tracksColors() && !bumped());
}

bool SurfaceState::phongMaterial() const
{
    if (_brdf >= 0 || unlit() || !osgMaterial() || paintedReflection()) return false;
    const osg::Vec4& s = osgMaterial()->getSpecular(osg::Material::FRONT);
    return s.r() > 0.0f || s.g() > 0.0f || s.b() > 0.0f;
}

bool SurfaceState::twoSided() const
{
    const auto* model = _lightModel.as<osg::LightModel>();
    const osg::Material* m = osgMaterial();
    if (!model || !model->getTwoSided() || !m || _brdf >= 0 || unlit()) return false;
    return !m->getDiffuseFrontAndBack() || !m->getSpecularFrontAndBack() || !m->getEmissionFrontAndBack() ||
           !m->getShininessFrontAndBack();
}

bool SurfaceState::clipped() const
{
    return std::any_of(_clipPlanes.begin(), _clipPlanes.end(), [](const Mode& plane) { return plane.on; });
}

bool SurfaceState::translucent(const osg::Geometry* geometry) const
{
    if (texture() && textureMode() != TEXTURE_DECAL && textureFacts().translucent) return true;
    if (_laterUnits)
        for (const TextureStage& s : stages(geometry)) {
            const bool takesAlpha =
                s.kind == limits::STAGE_MODULATE || s.kind == limits::STAGE_REPLACE || s.kind == limits::STAGE_BLEND;
            if (takesAlpha && factsOf(*_units[size_t(s.unit)].texture.as<osg::Texture>()).translucent) return true;
        }
    const osg::Material* m = osgMaterial();
    if (!vertexColored()) return m && m->getDiffuse(osg::Material::FRONT).a() < 1.0f;
    const osg::Array* colors = geometry ? geometry->getColorArray() : nullptr;
    return colors && (_facts ? _facts->isTranslucent(*colors) : SurfaceFacts::measure(*colors));
}

bool SurfaceState::blended(const osg::Geometry* geometry) const
{
    return (_blending.on || _alphaToCoverage.on) && translucent(geometry);
}

bool SurfaceState::depthWritten() const
{
    const auto* depth = _depth.as<osg::Depth>();
    return !depth || depth->getWriteMask();
}

bool SurfaceState::atFarPlane() const
{
    const auto* depth = _depth.as<osg::Depth>();
    return depth && depth->getZNear() == depth->getZFar();
}

bool SurfaceState::drawnForward(const osg::Geometry* geometry) const
{
    return _ownProgram || !storesDepth() || blended(geometry) || unsupported(geometry);
}

// By what its alpha leaves, in the two forms that draw an opaque surface as without blending.
SurfaceState::Blending SurfaceState::blendingKind() const
{
    const auto* function = _blendFunction.as<osg::BlendFunc>();
    const auto* equation = _blendEquation.as<osg::BlendEquation>();
    if (equation && equation->getEquation() != osg::BlendEquation::FUNC_ADD) return BLENDS_OTHERWISE;
    if (!_blendFunction.attribute) return BLENDS_BY_ALPHA;
    if (!function) return BLENDS_OTHERWISE;
    const GLenum source = function->getSource(), destination = function->getDestination();
    if (source == osg::BlendFunc::SRC_ALPHA && destination == osg::BlendFunc::ONE_MINUS_SRC_ALPHA) return BLENDS_BY_ALPHA;
    if (source == osg::BlendFunc::ONE && destination == osg::BlendFunc::ONE_MINUS_SRC_ALPHA) return BLENDS_PREMULTIPLIED;
    return source == osg::BlendFunc::ONE && destination == osg::BlendFunc::ZERO ? BLENDS_BY_ALPHA : BLENDS_OTHERWISE;
}

bool SurfaceState::casts(const osg::Geometry* geometry) const
{
    if (_shadowCatcher) return false;
    if (_stencil.on || _logicOp.on || _colorMask.attribute || (_blending.on && blendingKind() == BLENDS_OTHERWISE)) return false;
    return depthTested() && (depthWritten() || blended(geometry));
}

const char* SurfaceState::unsupportedRaster(const osg::Geometry* geometry) const
{
    if (_vertexProgram.on || _fragmentProgram.on) return "ARB vertex and fragment programs";
    if (_stencil.on) return "the stencil test";
    if (_scissor.on) return "the scissor test";
    if (_logicOp.on) return "logic operations";
    if (_colorMask.attribute) return "colour masks";
    const Blending blending = _blending.on ? blendingKind() : BLENDS_BY_ALPHA;
    if (blending == BLENDS_OTHERWISE || (blending == BLENDS_PREMULTIPLIED && translucent(geometry)))
        return "blending other than by alpha";
    const auto* depth = _depth.as<osg::Depth>();
    // What writes no depth is drawn forward, where all tests are as without us.
    if (storesDepth() && (orderOf(depth) == 0 || orderOf(depth) != orderOf(_nodeDepth) || !sameDepthRange(depth, _nodeDepth)))
        return "depth tests for other than the nearest, and depth ranges";
    return nullptr;
}

const char* SurfaceState::unsupported(const osg::Geometry* geometry) const
{
    if (_ownProgram) return nullptr;
    if (geometry && onlyPointsAndLines(*geometry)) return "points and lines";
    const char* what = unsupportedRaster(geometry);
    // A BRDF of ours says what the surface is, whatever fixed-function texturing is there beside it.
    return what || _brdf >= 0 ? what : unsupportedTexture(geometry);
}

}  // namespace osgEnvLight
