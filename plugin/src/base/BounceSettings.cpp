// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> BounceSettings::properties()
{
    using S = BounceSettings;
    using namespace rows;
    return {
        choice(
            "bounce", &S::bounce, {"off", "mean"},
            "what is reflected from surface to surface: nothing, or the mean of what the picture shows where light is blocked, "
            "by the share of directions that a pixel does not see of the map"),
    };
}

}  // namespace osgEnvLight
