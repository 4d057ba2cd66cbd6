/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Plan>
#include <osgEnvLight/Settings>
#include "environment/DominantLight.h"
#include "lights/DiffuseCarrier.h"

#include <vector>

namespace osgEnvLight
{

/** What one view of this scene, under this map and these settings, requires: which passes run, and why. */
struct OSGENVLIGHT_EXPORT FramePlan {
    bool diffuse = false;
    bool specular = false;
    bool lobes = false;  // S is occluded
    bool occlusion = false;
    SurfaceKinds surfaces;
    unsigned diffuseHarmonics = 0;  // 9, 18, or 0 when lights carry D
    unsigned diffuseLights = 0;     // 0 when spherical harmonics carry D
    bool atlas = false;             // the sky shadow atlas says what O's lights see
    bool screen = false;            // the depth buffer does
    bool bounce = false;            // the mean of what blocks light lights in its place
    bool accumulate = false;        // a still view converges
    unsigned occlusionLights = 0;   // a multiple of 16
    unsigned suns = 0;              // cut from the map
    bool sunDiffuse = false;        // in D too, not only in S
    bool sunMaps = false;           // they have shadow maps
    bool sunShadows = false;        // which say what of them the surfaces in the G-buffer see
    bool sceneLights = false;       // those of the application are added to the G-buffer's emission

    std::vector<PassReport> passes;  // in the order of the frame, with neither times nor bytes

    /** @param mapIsBlack   no radiance anywhere, or intensity 0
     * @param sceneRadius  of the node's bound; 0 for an empty scene
     * @param suns         those cut from the map, and their share of its flux
     * @param carrier      what carries D on this map, and why
     * @param casters      drawables that cast shadows, in view or not; 0 where nobody asked (wantsAtlas, wantsSunShadows)
     * @param ownGBuffer   not the application's, of which nobody knows when it changes*/
    static FramePlan make(const Settings& settings, const SurfaceKinds& surfaces, bool mapIsBlack, double sceneRadius,
                          const DiffuseCarrier& carrier, const SunShare& suns = SunShare(), size_t casters = 0,
                          bool ownGBuffer = true);

    /** The pass of the application's lights, of which count are switched on. */
    void decideSceneLights(const Settings& settings, size_t count, bool ownGBuffer);

    /** Whether the settings leave it to the casters if there is an atlas. */
    static bool wantsAtlas(const Settings& settings);
    /** The same of the suns' shadow maps. */
    static bool wantsSunShadows(const Settings& settings);

    /** What applications are told of it. */
    Plan report() const;
};

}  // namespace osgEnvLight
