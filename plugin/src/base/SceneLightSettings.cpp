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
               "the lights of osg::LightSource nodes, without shadows; auto: but not the viewer's own head or sky light"),
    };
}

}  // namespace osgEnvLight
