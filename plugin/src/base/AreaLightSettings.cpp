// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> AreaLightSettings::properties()
{
    using S = AreaLightSettings;
    using namespace rows;
    return {
        number("areaPoints", &S::areaPoints, 16, 1024, "points",
               "points on all area lights together, each with a shadow map, a sixteenth of them in each pixel; rounded up to a "
               "multiple of 16, and up to twice as many where there are more lights"),
        choice("manyLights", &S::manyLights, {"points", "lightcuts"},
               "what stands for more than eight area lights: the points that have shadow maps, or in each pixel a cut through a "
               "tree of the lights, whose near ones have their closed forms"),
        uniform(real(
            "lightCutError", &S::lightCutError, 0, 1, "",
            "bound of what a cluster of such a cut may differ from its lights, in shares of what a surface gets of all lights")),
        onOff("emissiveMeshes", &S::emissiveMeshes,
              "whether what glows in a model is an area light by itself (Material::setLight); else its light is indirect light "
              "alone"),
        number("areaMapSize", &S::areaMapSize, 16, 512, "texels", "side of each of these shadow maps"),
    };
}

}  // namespace osgEnvLight
