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
               "of bounce=probes: along the longer sides of the scene, half as many along the shortest; as many in each of two "
               "finer grids where the view shows a small part of a large scene, and there at most 20"),
        choice("bounceNear", &S::bounceNear, {"off", "auto", "on"},
               "of bounce=probes: a ray from each pixel finds the surfaces close by, whose light the probes mix with that of "
               "others; auto: where many probes see little of the map, as in rooms"),
        uniform(
            real("bounceNearDistance", &S::bounceNearDistance, 0.125, 4, "distances between probes", "how far that ray goes")),
        choice(
            "caustics", &S::caustics, {"off", "auto", "on"},
            "of bounce=probes: polished metal throws suns and lamps onto other surfaces, by virtual lights; else it sends their "
            "light on as evenly as other surfaces do; auto: where at least a thirty-second of all surfaces is of such metal"),
        number("causticLights", &S::causticLights, 16, 4096, "lights",
               "virtual lights of all metal together, a sixteenth of them in each pixel; rounded up to a multiple of 16"),
        number("causticMapSize", &S::causticMapSize, 32, 1024, "texels",
               "side of the map by which they are chosen, for each sun or lamp; rounded up to a power of two"),
    };
}

}  // namespace osgEnvLight
