// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/EnvironmentMap>
#include <osgEnvLight/LightFile>

#include <string>

/** What is worth knowing about a list beside it. */
struct Statistics {
    unsigned requested = 0;
    double milliseconds = 0.0;  // to cut the suns and to sample the rest
    double rotation = 0.0;      // of the directions against the map [degrees]

    /** An object in JSON.
     * @param map      the whole of it
     * @param sampled  what the list is of: the map without the suns
     * @param file     directions as sampled, not turned */
    std::string json(const osgEnvLight::RadianceMap& map, const osgEnvLight::RadianceMap& sampled,
                     const osgEnvLight::LightFile& file) const;
};
