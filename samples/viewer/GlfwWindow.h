// SPDX-License-Identifier: MIT
#pragma once

#include "InputEvent.h"

#include <string>
#include <vector>

struct GLFWwindow;

/** A window with an OpenGL compatibility context, current in the thread that made it, and what the user does in it. */
class GlfwWindow
{
  public:
    /** Throws std::runtime_error that says why there is no window. */
    GlfwWindow(int width, int height, const std::string& title);
    ~GlfwWindow();
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    GLFWwindow* handle() const { return _window; }
    /** Of the picture in pixels, which on some screens are finer than the units of the window; 0 while it is minimised. */
    int width() const { return _width; }
    int height() const { return _height; }
    /** Whether there is a picture to draw: it is not minimised. */
    bool isShown() const;
    /** How many pixels high a text should be for one on a usual screen. */
    float contentScale() const;
    /** Pixels of the picture per unit of the window, in which GLFW and Dear ImGui measure. */
    float pixelsPerUnit() const;

    /** What was done since the last call; waits so long for something, 0: does not wait. */
    std::vector<InputEvent> takeEvents(double seconds);
    void swap();
    void setTitle(const std::string& title);
    void setClipboard(const std::string& text);
    void toggleFullScreen();
    bool isClosing() const;
    void close();

  private:
    struct Place {
        int x, y, width, height;
    };

    void installCallbacks();
    InputEvent pointerEvent(InputEvent::Type type) const;
    void addKey(int key, bool control);
    static void keyChanged(GLFWwindow* window, int key, int scancode, int action, int modifiers);

    /** GLFW itself, ended after the window. */
    struct Library {
        Library();
        ~Library();
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };

    const Library _library;
    GLFWwindow* _window = nullptr;
    int _width = 0;
    int _height = 0;
    Place _windowed{};       // where it was before it filled the screen
    double _pointerX = 0.0;  // at the time of the last event, in units of the window
    double _pointerY = 0.0;
    bool _repeats = false;  // the key that is down
    std::vector<InputEvent> _events;
};
