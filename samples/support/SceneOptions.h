// SPDX-License-Identifier: MIT
// What the programs that picture a scene take from their command lines alike: scene, map, camera, size, settings.
#pragma once

#include "CommandLine.h"

#include <osgEnvLight/LitScene>

#include <osg/Camera>

#include <optional>
#include <string>
#include <vector>

struct SceneOptions {
    bool interactive = false;  // starts without a scene, too, takes MAP after it, and does not wait for a new map's light
    std::string scene;
    std::string map;
    std::string layout;
    std::optional<double> rotation;
    std::optional<double> intensity;
    std::string camera;
    std::vector<double> eye;
    std::vector<double> target;
    std::vector<double> up;
    std::optional<double> fovy;
    std::string size = "512x512";
    std::vector<std::string> settings;
    int width = 0;  // from size, by check()
    int height = 0;

    /** To a program's options. */
    void addTo(CommandLine& line);

    /** Throws BadArguments for what no file need be read to refuse. */
    void check();

    /** The scene under its map and settings (applySettings); linear: output is scene-linear radiance. Throws BadArguments, or
     * std::runtime_error with the reader's message.*/
    osg::ref_ptr<osgEnvLight::LitScene> load(bool linear) const;

    /** Those of --set. Throws BadArguments. */
    void applySettings(osgEnvLight::Settings& changed) const;

    /** Vertical, degrees, of scenes without a view of their own: the command line's, else osgviewer's. */
    double openingAngle() const;

    /** Of the command line, else the scene's own, else osgviewer's home position. */
    osgEnvLight::HomeView view(osgEnvLight::LitScene& lit) const;

    /** The camera's projection and view. */
    void setCamera(const osgEnvLight::HomeView& view, osg::Camera& camera) const;
    void setCamera(osgEnvLight::LitScene& lit, osg::Camera& camera) const { setCamera(view(lit), camera); }

    /** The camera of the command line, else the scene's, else none. */
    std::optional<osgEnvLight::HomeView> chosenView(osgEnvLight::LitScene& lit) const;

  private:
    osgEnvLight::HomeView namedView(osgEnvLight::LitScene& lit) const;
};
