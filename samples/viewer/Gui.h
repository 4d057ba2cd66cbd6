// SPDX-License-Identifier: MIT
#pragma once

#include "GlfwWindow.h"

/** Dear ImGui in a window: what stands between the parts of the panel and OpenGL. */
class Gui
{
  public:
    /** It sees the window's events, too, from here on. */
    explicit Gui(GlfwWindow& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /** Windows, texts and sliders go between these. */
    void beginFrame();
    void endFrame();
    /** Draw them over what the window shows; OpenGL's state is left as it was. */
    void draw();

    /** After beginFrame(): whether the pointer, or what is typed, is meant for a part of it. */
    bool wantsPointer() const;
    bool wantsKeys() const;
    /** While a slider is dragged. */
    bool isInUse() const;
};
