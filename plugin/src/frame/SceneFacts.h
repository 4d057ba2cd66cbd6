/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "environment/DominantLight.h"
#include "frame/Requirement.h"
#include "lights/DiffuseCarrier.h"

#include <osgEnvLight/Plan>
#include <osgEnvLight/Settings>

#include <string>

namespace osgEnvLight
{

/** What a view shows in a frame, and under which map. */
struct SceneFacts {
    SurfaceKinds surfaces;
    bool mapIsBlack = false;   // no radiance anywhere, or intensity 0
    double sceneRadius = 0.0;  // of the node's bound; 0 for an empty scene
    DiffuseCarrier carrier;    // what carries D on this map, and why
    SunShare suns;             // those cut from the map
    size_t casters = 0;        // drawables that cast shadows, in view or not; 0 where nobody asked
    size_t sceneLights = 0;    // the application's lights that are switched on
    size_t areaLights = 0;
    bool ownGBuffer = true;  // not the application's, of which nobody knows when it changes

    /** Lights in the scene, beside those of the map. */
    bool hasLamps() const { return areaLights + sceneLights > 0; }
    /** The reason of passes over the G-buffer where it is empty. */
    const char* whyNoneIsDeferred() const;
};

/** What several passes depend on. */
struct OSGENVLIGHT_EXPORT Decisions {
    Requirement light;                  // diffuse light of the map
    Requirement suns;                   // lights of their own, apart from the map
    Requirement sunMaps;                // their shadow maps
    Requirement atlas;                  // shadow maps of the map's lights: the sky shadow atlas
    Requirement occlusion;              // of the surfaces in the G-buffer
    Requirement average;                // of the picture, over the frames before
    bool sunDiffuse = false;            // suns are in D too, not only in S
    bool screen = false;                // the depth buffer says what occludes, alone or beside the atlas
    unsigned occlusionLights = 0;       // a multiple of 16
    unsigned askedOcclusionLights = 0;  // before it was rounded up

    static Decisions make(const SceneFacts& facts, const Settings& settings);

    /** Whether the settings leave it to the casters if there is an atlas. */
    static bool wantsAtlas(const Settings& settings);
    /** The same of the suns' shadow maps. */
    static bool wantsSunMaps(const Settings& settings);
    /** Whether they leave it to the casters if area lights have shadow maps. */
    static bool wantsEmitterMaps(const Settings& settings);
    /** Whether they leave it to the surfaces if the picture is averaged over frames. */
    static bool wantsAverage(const Settings& settings);
};

/** "3 lights", "1 light" */
std::string counted(size_t n, const char* noun);

}  // namespace osgEnvLight
