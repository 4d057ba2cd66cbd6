// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> BounceSettings::properties()
{
    using S = BounceSettings;
    using namespace rows;
    return {
        choice("bounce", &S::bounce, {"off", "mean", "probes"},
               "what is reflected from surface to surface: nothing; the mean of what the picture shows where light is blocked, "
               "by the share of directions that a pixel does not see of the map; or light that goes on between points of all "
               "surfaces, "
               "seen by probes about each pixel"),
        number("bounceProbes", &S::bounceProbes, 4, 32, "probes",
               "of bounce=probes: along the longer sides of the scene, half as many along the shortest"),
    };
}

}  // namespace osgEnvLight
