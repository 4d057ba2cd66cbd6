/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "base/Limits.h"
#include "surface/SurfaceSorter.h"

#include <osg/Light>
#include <osg/Uniform>
#include <osg/View>
#include <osgUtil/RenderStage>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace osgEnvLight
{

/** One osg::Light of the application's as the shaders take it, in eye space. */
struct SceneLight {
    unsigned number = 0;  // i of GL_LIGHTi
    std::string name;     // for messages
    osg::Vec3f color;     // GL's diffuse; its ambient the environment replaces, its specular is the BRDF's matter
    osg::Vec4f position;  // w = 1; of a directional light the unit direction to it, w = 0
    osg::Vec4f spot;      // unit direction of the cone, cosine of its cutoff; -2: no cone
    osg::Vec4f falloff;   // constant, linear, quadratic attenuation; exponent of the spot
    bool ofView = false;  // the viewer's own head or sky light

    bool operator==(const SceneLight& o) const
    {
        return number == o.number && color == o.color && position == o.position && spot == o.spot && falloff == o.falloff;
    }
};
using SceneLightList = std::vector<SceneLight>;

/** Whether any is a light of the scene: the viewer's own casts no shadows. */
OSGENVLIGHT_EXPORT bool castShadows(const SceneLightList& lights);

/** Which shadow maps are a light's, by its number: the first, and how many. */
using SceneLightFaces = std::array<std::pair<unsigned, unsigned>, limits::MOST_SCENE_LIGHTS>;

/** Those of a stage, one for each GL_LIGHTi: where several have a number, the last counts, as in OpenGL. In the middle of cull
 * they are those of the LightSources met so far.
 * @param view      whose head or sky light is left out; null: a bare SceneView's
 * @param withView  it is not left out */
OSGENVLIGHT_EXPORT SceneLightList findSceneLights(osgUtil::RenderStage& stage, const osg::View* view, bool withView);

/** Bits i of the GL_LIGHTi that are on in the state of some, and of all, of the surfaces. */
struct LightModes {
    unsigned some = 0;
    unsigned all = 0xff;
};
OSGENVLIGHT_EXPORT LightModes findLightModes(osgUtil::RenderBin& gbuffer, const std::vector<ForwardGraph>& forward);

/** Those whose bit is set. */
OSGENVLIGHT_EXPORT SceneLightList switchedOn(SceneLightList lights, unsigned modes);

/** The uniforms of pass/scenelights.glsl. */
class OSGENVLIGHT_EXPORT SceneLightUniforms
{
  public:
    static constexpr unsigned maximum = limits::MOST_SCENE_LIGHTS;

    SceneLightUniforms();
    /** With the maps of faces. */
    void set(const SceneLightList& lights);
    void addTo(osg::StateSet& state) const;

    SceneLightFaces faces = {};

  private:
    osg::ref_ptr<osg::Uniform> _count, _color, _position, _spot, _falloff, _faces;
};

}  // namespace osgEnvLight
