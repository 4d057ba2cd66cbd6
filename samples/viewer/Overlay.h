// SPDX-License-Identifier: MIT
// What lies over the picture, beside the panel; parts of Dear ImGui that take no input.
#pragma once

#include <string>

/** The list of keys, and what the mouse does. */
void showKeys();

/** In the middle of a window without a scene. */
void showDropHint();

/** A line at the bottom. */
void showMessage(const std::string& text, bool isError);
