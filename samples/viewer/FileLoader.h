// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

#include <string>

/** What a file was that was read into a scene. */
enum class Loaded { NOTHING, MAP, MODEL, SCENE };

/** A model replaces what the scene shows, a lit scene (.envlight) its map, settings and home view, too, an image its map. NOTHING
 * and a message that names the file and the reason if it is none of these; all stays as it was. */
struct LoadedFile {
    Loaded kind = Loaded::NOTHING;
    std::optional<osgEnvLight::HomeView> homeView;
    std::string error;
};
LoadedFile loadFile(const std::string& name, osgEnvLight::LitScene& lit);
