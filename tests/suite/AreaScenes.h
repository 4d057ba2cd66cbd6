// SPDX-License-Identifier: MIT
// Scenes by which shadows of area lights are judged, those of area-lights.md 1: white surfaces under a black map, direct light
// alone.
#pragma once

#include "TracedView.h"

#include <metrics/Metrics>

#include <string>

namespace suite
{

/** table: turned boxes under a rectangle; room: closed, with furniture and a window; grille: poles before a disc; strips: a
 * screen that stands on strips of metal of roughness .1, .3, .6; many: 16 unlike rectangles over boxes and columns;
 * city: 832 lamps and signs between houses; stripes and screen: table and strips, whose light shows a picture. The renderer's
 * camera is set to look at it. Throws std::runtime_error for another name. */
osg::ref_ptr<osgEnvLight::LitScene> makeAreaScene(const std::string& name, SceneRenderer& renderer);
extern const char* const areaScenes[8];
/** Frames until a view knows which lights matter to it. */
const int areaFrames = 5;

/** What a scene's picture should be, and the pixels that count. */
struct AreaTruth {
    Picture picture;
    Picture error;  // standard
    osgEnvLight::Mask mask;
};
AreaTruth tracedArea(osgEnvLight::LitScene& lit, SceneRenderer& renderer, unsigned samples,
                     osgEnvLight::ReferenceOptions::Paths paths = osgEnvLight::ReferenceOptions::DIRECT);

}  // namespace suite
