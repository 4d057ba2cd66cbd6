// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SurfaceSettings::properties()
{
    using S = SurfaceSettings;
    using namespace rows;
    return {
        uniform(choice(
            "materialColors", &S::materialColors, {"srgb", "linear"},
            "colours of osg::Material, of vertices and of unlit surfaces: display values, shown under the map's exposure as "
            "typed, or scene-linear; colours of our own Material are always linear")),
    };
}

}  // namespace osgEnvLight
