// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SceneLightSettings::properties()
{
    using S = SceneLightSettings;
    using namespace rows;
    return {
        choice("sceneLights", &S::sceneLights, {"auto", "on", "off"},
               "the lights of osg::LightSource nodes; auto: but not the viewer's own head or sky light"),
        onOff("sceneLightShadows", &S::sceneLightShadows, "they cast shadows"),
        number("sceneLightMapSize", &S::sceneLightMapSize, 16, 2048, "texels",
               "side of their shadow maps: one of a spot and of a directional light, six of a point light"),
    };
}

}  // namespace osgEnvLight
