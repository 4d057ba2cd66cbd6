// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> BackgroundSettings::properties()
{
    using S = BackgroundSettings;
    using namespace rows;
    return {
        choice("background", &S::background, {"off", "on", "blur", "auto"},
               "the map behind the scene; auto: unless a sky or backdrop of the application's, below the node or drawn before it "
               "in a negative bin, is there, or the scene has fog of the colour to which the host clears"),
        uniform(real("backgroundBlur", &S::backgroundBlur, 0, 90, "degrees", "width of the blur of background = blur")),
        choice("ground", &S::ground, {"off", "shadows"},
               "a level ground below the scene that shows the map behind it, and the shadows on it; it is as low as the scene "
               "has been"),
        real("groundMapHeight", &S::groundMapHeight, 0, 1e6, "units",
             "above that ground from which the map was taken: the map lies on the ground, and the scene stands still on it when "
             "the view moves; 0: all of the map is infinitely far"),
    };
}

}  // namespace osgEnvLight
