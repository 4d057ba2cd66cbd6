// SPDX-License-Identifier: MIT
#pragma once

#include "SceneOptions.h"

/** The views of which envlight-render makes pictures, and the files in which it puts them. */
struct Views {
    std::string camerasFile;
    int turntable = 0;     // pictures of a full turn; 0: no turntable
    std::string part;      // "K/N": of N jobs that share the pictures, the K-th
    bool resumes = false;  // pictures that are there already are not made again

    void addTo(CommandLine& line);

    /** Whether there is a picture for each of several views. */
    bool several() const { return !camerasFile.empty() || turntable > 0; }

    /** Those of the cameras, or of the turn, counter-clockwise seen from above, about the axis through what the scene's view
     * looks at. Throws BadArguments, or std::runtime_error with the reader's message. */
    std::vector<osgEnvLight::HomeView> of(osgEnvLight::LitScene& lit, const SceneOptions& scene) const;

    /** Whether this job makes the picture. Throws BadArguments. */
    bool makes(size_t index, const std::string& file) const;
};

/** The output's name with the picture's number, from 1, before its extension: turn.png becomes turn-0001.png. */
std::string numbered(const std::string& output, size_t index);
