// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> DiffuseSettings::properties()
{
    using S = DiffuseSettings;
    using namespace rows;
    return {
        choice(
            "diffuseCarrier", &S::diffuseCarrier, {"auto", "sh", "lights"},
            "what D sums: 18 spherical harmonics of the map, diffuseLights of its lights, or the cheapest within diffuseError"),
        real("diffuseError", &S::diffuseError, 0, 100, "percent",
             "RMS error of D that diffuseCarrier = auto allows; where nothing keeps it, the most exact is taken"),
        number("diffuseLights", &S::diffuseLights, 1, 65536, "lights",
               "importance-sampled lights of the map for D; with diffuseCarrier = auto, at most"),
    };
}

}  // namespace osgEnvLight
