/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/LightTexture.h"
#include <osgEnvLight/Settings>

#include <memory>

namespace osgEnvLight
{

/** What of Settings decides how a map is made into light. */
struct OSGENVLIGHT_EXPORT MapOptions {
    /** Of the default settings. */
    MapOptions();
    MapOptions(const Settings& settings, const std::shared_ptr<const LightList>& given = nullptr);

    std::shared_ptr<const LightList> given;  // lights that the application made; null: a sampler makes them
    int sampler;                             // index into LightSampler::names()
    SampleOptions sampling;
    LightDeal deal;
    int suns;
    int diffuseCarrier;
    unsigned diffuseLights;
    double diffuseError;

    bool sameLists(const MapOptions& o) const;
    bool sameCarrier(const MapOptions& o) const;
};

}  // namespace osgEnvLight
