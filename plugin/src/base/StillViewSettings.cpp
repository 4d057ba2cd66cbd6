// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> StillViewSettings::properties()
{
    using S = StillViewSettings;
    using namespace rows;
    return {
        onOff("accumulate", &S::accumulate,
              "while camera, scene and map stand still, average frames with fresh lights, shadow maps and sub-pixel offsets "
              "until the picture is that of exact direct light"),
        number("accumulateFrames", &S::accumulateFrames, 1, 65536, "frames", "frames that a still view averages before it rests"),
        number(
            "accumulateLights", &S::accumulateLights, 16, 1024, "lights per frame",
            "fresh lights of the map, each with a shadow map of its own, in each frame of a still view; rounded up to a multiple "
            "of 16"),
        number("accumulateSize", &S::accumulateSize, 16, 4096, "texels",
               "side of the shadow maps of a still view, half of it in the first 15 frames"),
        uniform(number(
            "accumulateRays", &S::accumulateRays, 0, 64, "rays per pixel",
            "rays through the scene in each frame of a still view, which find what other surfaces send to a pixel; glossy "
            "pixels have one more, in their lobe; 0: the probes and the first frame's reflections say it, with less accuracy")),
    };
}

}  // namespace osgEnvLight
