// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

#include <string>

/** What a scene was before anything was changed by hand. */
struct SceneOrigin {
    std::string file;  // empty: none
    std::string map;
    osg::ref_ptr<const osgEnvLight::Settings> settings;
};

/** The command that renders what is shown, for a shell: envlight-render with the scene, its map, settings and camera. */
std::string renderCommand(const osgEnvLight::LitScene& lit, const SceneOrigin& origin, const osgEnvLight::HomeView& view,
                          int width, int height);
