// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SpecularSettings::properties()
{
    using S = SpecularSettings;
    using namespace rows;
    return {
        choice("specularMethod", &S::specularMethod, {"sampled", "prefiltered"},
               "what S takes of the map: samples of the BRDF, or one look-up in the map as GGX's lobes seen from straight above "
               "filter it, which is faster, and wrong where a lobe is drawn out, at grazing angles or brushed"),
        uniform(number("specularSamples", &S::specularSamples, 1, 1024, "samples per pixel",
                       "directions sampled from the BRDF for S, with specularMethod = sampled")),
        choice(
            "reflections", &S::reflections, {"off", "map", "indirect", "screen", "scene"},
            "what glossy surfaces show: the map, whatever is in the way; the map where it is seen, and black else; there the "
            "scene's indirect light, that of its probes or the mean; or what the picture shows of the scene, and indirect light "
            "where it shows nothing; or there what rays through the scene's triangles meet, with bounce = probes"),
        uniform(number("reflectionSteps", &S::reflectionSteps, 1, 256, "points per ray",
                       "points at which a reflected ray is compared with the depth buffer, with reflections = screen or scene")),
    };
}

}  // namespace osgEnvLight
