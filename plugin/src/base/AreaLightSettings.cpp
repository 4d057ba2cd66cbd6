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
               "multiple of 16"),
        onOff("emissiveMeshes", &S::emissiveMeshes,
              "whether what glows in a model is an area light by itself (Material::setLight); else its light is indirect light "
              "alone"),
        number("areaMapSize", &S::areaMapSize, 16, 512, "texels", "side of each of these shadow maps"),
    };
}

}  // namespace osgEnvLight
