// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

#include <string>

class HeadlessContext;

/** What --stats writes: the renderer, the plan with its reasons, milliseconds per pass and per frame, memory. */
struct Statistics {
    std::string scene;
    int width = 0;
    int height = 0;
    int frames = 0;
    double firstFrame = 0.0;  // milliseconds
    double lastFrame = 0.0;

    /** False and a message naming the file if it can't be written. */
    bool write(const std::string& fileName, const osgEnvLight::LitScene& lit, const HeadlessContext& context,
               std::string& error) const;
};
