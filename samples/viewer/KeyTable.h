// SPDX-License-Identifier: MIT
#pragma once

#include "InputEvent.h"

#include <string>
#include <vector>

/** What a key does. */
enum class Action {
    SHOW_KEYS,
    SHOW_PANEL,
    GO_HOME,
    NEXT_CAMERA,  // of the model
    FULL_SCREEN,
    QUIT,
    VIEW,  // of the row's value: Settings::View
    NEXT_VIEW,
    PRESET,  // of the row's value: index into Settings::presets()
    CONVERGE,
    BACKGROUND,
    GROUND,
    EXPOSURE,  // by so many stops
    TURN_MAP,  // by so many degrees
    UNDO,
    REDO,
    SAVE_PICTURE,
    SAVE_RADIANCE,
    COPY_COMMAND,
    RELOAD_SHADERS
};

/** A row of the list of keys. */
struct KeyBinding {
    int key;  // as in InputEvent
    bool control;
    bool repeats;  // while it is held down
    std::string label;
    std::string purpose;
    Action action;
    double value;
};

/** In the order of the list. */
const std::vector<KeyBinding>& keyTable();

/** The row of a key that was pressed, or null. */
const KeyBinding* findBinding(const InputEvent& event);
