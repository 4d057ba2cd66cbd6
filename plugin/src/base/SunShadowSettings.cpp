// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SunShadowSettings::properties()
{
    using S = SunShadowSettings;
    using namespace rows;
    return {
        number("sunShadowSize", &S::sunShadowSize, 64, 4096, "texels",
               "side of each sun's shadow maps; where there are more than four they share the memory of four"),
    };
}

}  // namespace osgEnvLight
