// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SpecularSettings::properties()
{
    using S = SpecularSettings;
    using namespace rows;
    return {
        uniform(number("specularSamples", &S::specularSamples, 1, 1024, "samples per pixel",
                       "directions sampled from the BRDF for S")),
        choice("reflections", &S::reflections, {"off", "map", "screen"},
               "what glossy surfaces show: the map, whatever is in the way; the map where it is seen, and black else; or that and "
               "the scene: what the picture shows of it, else its mean radiance"),
        uniform(number("reflectionSteps", &S::reflectionSteps, 1, 256, "points per ray",
                       "points at which a reflected ray is compared with the depth buffer, with reflections = screen")),
    };
}

}  // namespace osgEnvLight
