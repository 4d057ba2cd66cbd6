// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

/** The map's rotation and intensity, presets and all settings in their groups, to be changed. For a window of Dear ImGui. True if
 * one was. */
bool showSettings(osgEnvLight::LitScene& lit);
