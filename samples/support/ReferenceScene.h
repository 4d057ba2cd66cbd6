// SPDX-License-Identifier: MIT
#pragma once

#include "SceneOptions.h"

#include <osgEnvLight/LightFile>

#include <metrics/Picture>
#include <reference/Reference>

#include <memory>

/** A LitScene as the reference sees it, through the camera that envlight-render would draw it with, at the same instant. */
class ReferenceScene
{
  public:
    ReferenceScene(osgEnvLight::LitScene& lit, const SceneOptions& options);

    /** Leave of the environment the suns that the nodekit cuts from it. */
    void keepSuns();
    /** Light D by the list and its suns. */
    void setLights(const osgEnvLight::LightFile& file);

    const osgEnvLight::Reference& reference() const { return *_reference; }
    const osgEnvLight::TriangleScene& triangles() const { return _triangles; }
    /** Of the node's bound: the nodekit's unit of length. */
    double radius() const { return double(_lit.getBound().radius()); }

    /** A world normal as envlight-render's view of normals has it, in place. */
    void encodeNormal(float* normal) const;
    /** Exposed, tone mapped and encoded as the settings say.
     * @param albedo  of the surfaces, if the exposure follows the light on them; null: it follows the map alone */
    osg::ref_ptr<osg::Image> displayed(const osgEnvLight::Picture& picture, const osgEnvLight::Picture* albedo = nullptr) const;
    /** Whether the settings let the exposure follow the picture. */
    bool adapts() const;

  private:
    void makeReference();

    osgEnvLight::LitScene& _lit;
    osgEnvLight::TriangleScene _triangles;
    osgEnvLight::LightList _lights;
    std::unique_ptr<osgEnvLight::RayScene> _rays;
    std::unique_ptr<osgEnvLight::RayCamera> _camera;
    std::unique_ptr<osgEnvLight::Environment> _environment;
    std::unique_ptr<osgEnvLight::Reference> _reference;
};
