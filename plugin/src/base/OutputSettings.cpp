// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> OutputSettings::properties()
{
    using S = OutputSettings;
    using namespace rows;
    return {
        uniform(choice("view", &S::view,
                       {"beauty", "diffuse", "specular", "occlusion", "visibility", "albedo", "normal", "depth", "emission",
                        "bounce", "lights"},
                       "the picture, or one of its intermediates")),
        choice("output", &S::output, {"display", "linear"},
               "what the host receives: exposed, tone mapped and encoded for a display, or scene-linear radiance"),
        choice("exposureBase", &S::exposureBase, {"map", "picture", "none"},
               "what exposure adds to: stops that show a white surface at .63 in the middle between the map's mean and greatest "
               "irradiance; those, and as many more or less as bring white surfaces in the picture, by the light that they "
               "receive, to between .16 and 1.26; or 0"),
        shown(uniform(real("exposure", &S::exposure, -32, 32, "stops",
                           "added to exposureBase; radiance is multiplied by 2 to this power before the tone curve"))),
        shown(real("adaptationTime", &S::adaptationTime, 0, 60, "s",
                   "in which exposureBase=picture follows 63 % of a change of what the picture shows; 0: at once")),
        shown(uniform(choice(
            "toneCurve", &S::toneCurve, {"clip", "reinhard", "neutral", "shoulder"},
            "from radiance to the display's range: none, Reinhard 2002, Khronos PBR Neutral, or that with only its highlights "
            "bent"))),
        choice(
            "antialias", &S::antialias, {"off", "edges", "temporal"},
            "smooth what is shown on a display: the staircases of edges, or with the frames before also what flickers while the "
            "view moves; a still view's average (accumulate) needs neither"),
        shown(uniform(onOff("dither", &S::dither, "ordered dither of half an 8-bit step against bands"))),
    };
}

}  // namespace osgEnvLight
