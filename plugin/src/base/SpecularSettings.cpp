// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SpecularSettings::properties()
{
    using S = SpecularSettings;
    using namespace rows;
    return {
        uniform(number("specularSamples", &S::specularSamples, 1, 1024, "samples per pixel",
                       "directions sampled from the BRDF for S")),
    };
}

}  // namespace osgEnvLight
