// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> SkyShadowSettings::properties()
{
    using S = SkyShadowSettings;
    using namespace rows;
    return {
        choice(
            "visibility", &S::visibility, {"auto", "screen", "atlas", "both", "none"},
            "what O asks whether a light is seen: the depth buffer, which knows what the view shows; the sky shadow atlas, a "
            "small shadow map for each light; both, the depth buffer within nearRadius; auto: both where anything casts shadows"),
        number("atlasLights", &S::atlasLights, 16, 1024, "lights",
               "lights of the map that have a shadow map, a sixteenth of them in each pixel; rounded up to a multiple of 16"),
        number("atlasSize", &S::atlasSize, 16, 512, "texels", "side of each shadow map of the atlas"),
        number(
            "atlasUpdatesPerFrame", &S::atlasUpdatesPerFrame, 1, 1024, "maps per frame",
            "shadow maps of the sky, and as many of area lights, drawn again each frame while the scene, the map or the lights "
            "change, or parts of up to four times as many; the first frame draws a quarter of the sky's, which stand for all, "
            "and the next ones at least a sixteenth each; with regeneration = immediate, all"),
    };
}

}  // namespace osgEnvLight
