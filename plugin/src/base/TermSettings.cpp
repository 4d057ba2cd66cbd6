// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> TermSettings::properties()
{
    using S = TermSettings;
    using namespace rows;
    return {
        onOff("diffuse", &S::diffuse, "the term D: diffuse reflection of the map"),
        onOff("specular", &S::specular, "the term S: glossy reflection of the map"),
        onOff("occlusion", &S::occlusion, "the term O: what the scene itself keeps from D, with the shadows of the suns"),
    };
}

}  // namespace osgEnvLight
