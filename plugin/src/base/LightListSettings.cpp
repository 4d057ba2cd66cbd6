// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

const std::vector<const char*>& LightListSettings::lightSamplerNames()
{
    static const std::vector<const char*> names = {"auto", "split", "median-cut", "structured", "penrose", "inverse-cdf"};
    return names;
}

std::vector<SettingsProperty> LightListSettings::properties()
{
    using S = LightListSettings;
    using namespace rows;
    return {
        choice("lightSampler", &S::lightSampler, lightSamplerNames(), "how the map is made into lights (LightSampler)"),
        choice("lightWeights", &S::lightWeights, {"auto", "off", "on"},
               "reweighting of the lights by the map's spherical harmonics; auto: after split and auto"),
        real("lightFloor", &S::lightFloor, 0, 100, "means of the map",
             "radiance added to the map where lights are placed, so that dark parts have some; their flux stays true"),
        choice("lightDeal", &S::lightDeal, {"moments", "random"},
               "how lights are dealt to the 16 groups of O: each a good sample of the map, or shuffled"),
        choice("suns", &S::suns, {"off", "glossy", "auto"},
               "cut suns and lamps out of the map, shade them as discs and give each a shadow map: for S only, or for D as well"),
        choice("regeneration", &S::regeneration, {"background", "immediate"},
               "a changed map becomes light on a thread of its own, visible when ready, and shadow maps are drawn some a frame; "
               "or all within the frame that sees the change"),
    };
}

}  // namespace osgEnvLight
