// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> OcclusionSettings::properties()
{
    using S = OcclusionSettings;
    using namespace rows;
    return {
        uniform(real("nearRadius", &S::nearRadius, 0, 100, "texels of the atlas",
                     "how far O looks on the screen where the atlas knows the rest; 0: not at all")),
        number("nearSlices", &S::nearSlices, 1, 4, "slices a pixel", "occlusionSlices of that"),
        uniform(number("nearTaps", &S::nearTaps, 1, 32, "taps a side", "occlusionTaps of that")),
        number(
            "occlusionLights", &S::occlusionLights, 16, 65536, "lights",
            "lights whose visibility O tests on the screen, a sixteenth of them in each pixel; rounded up to a multiple of 16"),
        choice(
            "occlusionMethod", &S::occlusionMethod, {"slice", "ray", "point", "gtao", "bent-normal"},
            "how O searches the depth buffer: slices through the pixel, whose bits all its lights share, or a ray for each "
            "light; for comparison one point a ray, which seed 000 printed, the share of the sky above the slices' horizons, or "
            "the open share of it about its mean direction; beside the atlas always slices"),
        number("occlusionSlices", &S::occlusionSlices, 1, 4, "slices a pixel", "planes through the view ray that are searched"),
        uniform(number("occlusionTaps", &S::occlusionTaps, 1, 32, "taps a side",
                       "points of the depth buffer that each of a slice's two sides looks at")),
        uniform(number("occlusionSteps", &S::occlusionSteps, 1, 256, "points per ray",
                       "points at which a ray is compared with the depth buffer, with occlusionMethod = ray")),
        uniform(
            real("occlusionRadius", &S::occlusionRadius, 0, 100, "radii of the scene",
                 "how far O looks on the screen without an atlas: length of the rays, reach of the slices; 0 switches that off")),
        uniform(real("occlusionThickness", &S::occlusionThickness, 0, 1000, "radii of the occlusion",
                     "how deep a surface seen in the depth buffer is taken to be")),
    };
}

}  // namespace osgEnvLight
