/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"
#include "surface/StateValue.h"

#include <osg/Texture>

#include <array>

namespace osgEnvLight
{

/** How a texture joins the colour that the units before it leave: a stage of lib/limits.glsl. */
struct TextureStage {
    int kind = limits::STAGE_NONE;
    float scale = 1.0f;                     // of the sum or product: 1, 2 or 4
    int coordinates = limits::STAGE_GIVEN;  // where they come from
    int unit = 0;
};

/** What fixed-function state says of one texture unit. */
struct OSGENVLIGHT_EXPORT TextureUnit {
    StateMode texturing;
    StateMode otherTarget;  // than GL_TEXTURE_2D
    std::array<StateMode, 4> texGen;
    StateValue texture;
    StateValue texEnv;
    StateValue texGenMode;
    StateValue matrix;

    void mergeMode(osg::StateAttribute::GLMode mode, osg::StateAttribute::GLModeValue value);
    void mergeAttribute(osg::StateAttribute::Type type, const osg::StateSet::RefAttributePair& pair);

    /** A texture that OSG draws with, of whatever target. */
    bool hasTexels() const;
    bool generates() const { return texGen[0].on || texGen[1].on; }
    /** Both coordinates, or none, and those by planes. */
    bool generatesLinear() const;
    /** Where they come from, as TextureStage has it. A TexGenNode positions its planes in eye space, and no state set has them.
     */
    int coordinates() const;
    /** @param first  whether no unit comes before it, so that the primary colour is what it joins */
    TextureStage stage(bool first) const;
};

}  // namespace osgEnvLight
