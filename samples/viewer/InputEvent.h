// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

/** What the user did in the window. */
struct InputEvent {
    enum Type { KEY, PRESS, RELEASE, MOVE, SCROLL, DROP, REDRAW };

    Type type = REDRAW;
    int key = 0;            // KEY: the character that was typed, or a symbol of osgGA::GUIEventAdapter
    bool repeated = false;  // KEY: is held down
    int button = 0;         // PRESS, RELEASE: 1 left, 2 middle, 3 right
    bool shift = false;
    bool control = false;
    double x = 0.0;  // of the pointer, in pixels of the picture from the top left; SCROLL: steps
    double y = 0.0;
    std::vector<std::string> files;  // DROP
};
