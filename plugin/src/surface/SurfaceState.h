/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include <osgEnvLight/Material>
#include "surface/LampRule.h"
#include "surface/SurfaceFacts.h"
#include "surface/TextureUnit.h"

#include <osg/Depth>
#include <osg/Fog>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/StateSet>
#include <osg/Texture>

#include <array>

namespace osgEnvLight
{

/** What the state sets above a drawable say of its surface, where GLSL can't see it, merged as osg::State does: OVERRIDE,
 * PROTECTED and INHERIT count. What each of it means is decided here and nowhere else.*/
class OSGENVLIGHT_EXPORT SurfaceState
{
  public:
    /** @param facts  what is remembered of textures and colours; null: they are read at each question */
    explicit SurfaceState(SurfaceFacts* facts = nullptr) : _facts(facts) {}

    using Mode = StateMode;
    using Attribute = StateValue;

    /** Texture units of surfaces: those that fixed-function state reaches, and one more of our materials. */
    static constexpr unsigned units = 9;
    static constexpr unsigned fixedUnits = 8;

    /** Define that, ON in the state set of a Program of the user's, says it writes the G-buffer's outputs itself. */
    static const char* const gbufferDefine;

    /** The next state set on the way down. */
    void merge(const osg::StateSet& stateSet);
    /** What was said so far acts on the composite, not on single surfaces: programs, stencil, scissor, colour masks. */
    void enterNode();

    /** Of the BRDF that our Material chose, -1 without one. */
    int brdf() const { return _brdf; }
    /** Null without one. */
    const osg::Material* osgMaterial() const { return static_cast<const osg::Material*>(_material.attribute); }
    /** Of unit 0; null where it is off, has no texels, or paints a reflection that the lighting now makes itself. */
    const osg::Texture* texture() const;
    /** How unit 0 combines it with the colour below. */
    enum TextureMode { TEXTURE_MODULATES, TEXTURE_REPLACES, TEXTURE_DECAL, TEXTURE_BLENDS, TEXTURE_ADDS };
    TextureMode textureMode() const;
    /** Of unit 0; null where nothing is said. */
    const osg::StateAttribute* textureEnvironment() const { return _units[0].texEnv.attribute; }
    /** Where unit 0's coordinates come from. */
    enum Coordinates { FROM_VERTICES, FROM_OBJECT, FROM_EYE };
    Coordinates coordinates() const;
    /** Their fourth is generated, too. */
    bool projected() const { return _units[0].texGen[3].on; }
    TextureFacts textureFacts() const;
    /** How the texture units join the colour below them. Of unit 0 only whether it is a normal map: textureMode() says the rest.
     * A map in a later unit for which the drawable has no coordinates is one that a reader of files left there, as that of
     * OBJ does; fixed function would multiply by some one texel. It has those of unit 0 and is what its texels look
     * like: a normal map, a mask of holes, else nothing. Such maps take stages that are free.
     * @param geometry  null: not known; it has all coordinates */
    using Stages = std::array<TextureStage, limits::STAGED_UNITS>;
    Stages stages(const osg::Geometry* geometry) const;
    /** The unit of the mask among those stages; null: none. */
    const TextureUnit* mask(const osg::Geometry* geometry) const;
    /** Some map without coordinates is none of this. */
    bool leavesMapsOut(const osg::Geometry* geometry) const;
    /** A unit is a normal map of fixed function (DOT3). */
    bool bumped() const;
    /** It is white: its vertices' colours are directions to a light, and no material has another colour. */
    bool white() const;
    /** A sphere or cube map stands for a reflection: the surface is taken for polished metal of its colour. */
    bool paintedReflection() const;
    /** It adds to the surface's colour: the surface is taken for polished, not for metal. */
    bool paintedHighlight() const;
    /** GL_LIGHTING is off: the colour is what leaves the surface. */
    bool unlit() const { return !_lighting.on && _brdf < 0 && !bumped(); }
    /** The colour is the vertices' instead of the material's. */
    bool vertexColored() const;
    /** The osg::Material has a lobe. */
    bool phongMaterial() const;
    /** Back faces have a material of their own. */
    bool twoSided() const;
    /** It reads the texture of MaterialMaps::samplers[map]. */
    bool mapped(unsigned map) const;
    /** A Material says what reflectance it has where it is not metal. */
    bool dielectric() const { return _dielectric && cookTorrance(); }
    /** It has a clear coat. */
    bool coated() const { return _coat > 0.0f && _brdf == Material::COOK_TORRANCE; }
    /** Its highlights are drawn out along a direction. */
    bool anisotropic() const { return _anisotropy > 0.0f && _brdf == Material::COOK_TORRANCE && !coated(); }
    /** A Material says what its metal's edges reflect. */
    bool edged() const { return _edged && cookTorrance() && !coated() && !anisotropic(); }
    /** Its diffuse layer is not Lambert's. */
    bool roughDiffuse() const { return _diffuseRoughness > 0.0f && _brdf >= 0 && !coated() && !anisotropic() && !edged(); }
    /** A Material says that it shows what is behind it. */
    bool shadowCatcher() const { return _shadowCatcher; }
    /** A Material says what it emits. */
    bool emits() const { return _emits; }
    /** What it emits, linear, as typed; of a map the mean.
     * @param displayColors  the host's colours are display values, sRGB encoded */
    osg::Vec3f emission(bool displayColors) const;
    /** The same of a surface that is an area light by itself; black: it is none. */
    osg::Vec3f lampEmission(const LampRule& rule) const;
    /** One of its sides is not drawn. */
    bool culled() const { return _faceCulling.on; }
    /** What an AreaLight draws of itself. */
    bool isAreaLight() const { return _isAreaLight; }
    /** Planes of the host's cut it. */
    bool clipped() const;

    bool ownProgram() const { return _ownProgram; }
    /** Of SurfaceProgram; null: nothing moves its vertices. */
    const osg::Program* movingProgram() const { return _movingProgram; }
    /** Not for a G-buffer: blended, or drawn by the user's own program or against the depth buffer's rules. */
    bool drawnForward(const osg::Geometry* geometry) const;
    /** What of its state no pass of ours draws, so that it is drawn exactly as without the node; null if nothing is. */
    const char* unsupported(const osg::Geometry* geometry) const;
    /** That dims it where a program of ours draws it; null: none does. */
    const osg::Fog* fog() const { return _fog.on && !_ownProgram && !shadowCatcher() ? _fogAttribute.as<osg::Fog>() : nullptr; }
    /** The environment lights it where it is drawn forward, unless it is unsupported. */
    bool litForward() const { return _ownProgram ? _litProgram : _lighting.on; }
    /** A program of the user's asks the environment itself. */
    bool litProgram() const { return _ownProgram && _litProgram; }
    /** Whether the depth buffer decides if it is seen, and learns of it. */
    bool depthTested() const { return _depthTest.on; }
    bool depthWritten() const;
    /** All its depths are the far plane's, as a sky's. */
    bool atFarPlane() const;
    /** It stands in the scene: what lies behind it is hidden by the depth buffer. */
    bool storesDepth() const { return depthTested() && depthWritten() && !atFarPlane(); }
    /** Blended by its alpha. */
    bool blended(const osg::Geometry* geometry) const;
    /** Whether blending is on, whatever its alpha. */
    bool blending() const { return _blending.on; }
    /** False for what keeps no depth, as sky domes and overlays do: nothing lies behind it; and for what only changes the
     * picture behind it. */
    bool casts(const osg::Geometry* geometry) const;

  protected:
    SurfaceFacts* facts() const { return _facts; }
    TextureFacts factsOf(const osg::Texture& texture) const;
    /** TexMat of unit 0. */
    const osg::StateAttribute* firstMatrix() const { return _units[0].matrix.attribute; }

  private:
    void mergeMode(osg::StateAttribute::GLMode mode, osg::StateAttribute::GLModeValue value);
    void mergeAttribute(osg::StateAttribute::Type type, const osg::StateSet::RefAttributePair& pair);
    void mergeTextures(const osg::StateSet& stateSet);
    void mergeMaps(const osg::StateSet& stateSet);
    bool cookTorrance() const { return _brdf == Material::COOK_TORRANCE || _brdf == Material::BECKMANN; }
    bool translucent(const osg::Geometry* geometry) const;
    bool tracksColors() const;
    enum Blending { BLENDS_BY_ALPHA, BLENDS_PREMULTIPLIED, BLENDS_OTHERWISE };
    Blending blendingKind() const;
    const char* unsupportedRaster(const osg::Geometry* geometry) const;
    const char* unsupportedTexture(const osg::Geometry* geometry) const;
    bool lacksCoordinates(size_t unit, const osg::Geometry* geometry) const;
    int readerMap(size_t unit, const osg::Geometry& geometry) const;
    bool firstIsNormalMap() const;
    const TextureFacts& firstFacts() const;

    SurfaceFacts* _facts;
    Mode _lighting{true, 0};
    Mode _blending;
    Mode _alphaToCoverage;
    Mode _depthTest{true, 0};
    Mode _stencil;
    Mode _scissor;
    Mode _logicOp;
    Mode _fog;
    Mode _faceCulling;
    Mode _vertexProgram;
    Mode _fragmentProgram;
    std::array<Mode, 6> _clipPlanes;
    Attribute _material;
    Attribute _depth;
    Attribute _blendFunction;
    Attribute _blendEquation;
    Attribute _colorMask;
    Attribute _lightModel;
    Attribute _fogAttribute;
    std::array<TextureUnit, units> _units;
    std::array<TextureStage, units> _stages;
    bool _laterUnits = false;  // some stage after the first
    // Of unit 0, looked up when they are asked for.
    mutable const osg::StateAttribute* _firstKnown = nullptr;
    mutable TextureFacts _firstFacts;
    const osg::Depth* _nodeDepth = nullptr;
    bool _ownProgram = false;
    const osg::Program* _movingProgram = nullptr;
    bool _litProgram = false;  // it has a LightShader
    int _brdf = -1;
    std::array<int, 7> _mapUnits{};  // 0: none
    float _coat = 0.0f;              // its strength
    float _anisotropy = 0.0f;        // its strength
    bool _shadowCatcher = false;
    bool _dielectric = false;
    bool _edged = false;
    float _diffuseRoughness = 0.0f;
    bool _emits = false;
    osg::Vec3f _emission;  // where it does
    int _light = Material::LIGHT_AUTO;
    bool _isAreaLight = false;
    bool _ownVertexColors = false;  // a BRDF of ours takes them
};

}  // namespace osgEnvLight
