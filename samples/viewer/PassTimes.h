// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

// For a window of Dear ImGui.

/** How long the last frame took [milliseconds], and how far a still view has converged. */
void showProgress(const osgEnvLight::LitScene& lit, double frame);

/** The passes that run with their milliseconds, and why the others don't. */
void showPasses(const osgEnvLight::LitScene& lit);
