/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/SentLight.h"
#include "surface/SurfaceState.h"

namespace osgEnvLight
{

/** What the state sets above a drawable say of the light that it sends on: its colours, with the means of its textures and of its
 * vertices' colours. Where pass/surface.glsl knows them pixel by pixel, this is one for the whole drawable. */
class OSGENVLIGHT_EXPORT SentLightState : public SurfaceState
{
  public:
    explicit SentLightState(SurfaceFacts* facts = nullptr) : SurfaceState(facts) {}

    void merge(const osg::StateSet& stateSet);

    /** @param displayColors  the host's colours are display values, sRGB encoded */
    SentLight sentLight(const osg::Geometry& geometry, bool displayColors) const;

    /** Mean alpha of what is blended or perforated. */
    float opacity(const osg::Geometry& geometry) const;

  private:
    osg::Vec3f surfaceColor(const osg::Geometry& geometry, const osg::Vec3f& material, bool displayColors) const;
    SentLight hostLight(const osg::Vec3f& color, bool displayColors) const;
    /** Of our Material. */
    void setLayers(SentLight& sent, const osg::Vec3f& color) const;

    // Of our Material.
    osg::Vec3f _baseColor, _diffuse, _specular, _dielectric;
    float _metalness = 0.0f;
    float _smoothness = 0.0f;
    float _exponent = 0.0f;
    float _roughness = 0.0f;
};

}  // namespace osgEnvLight
