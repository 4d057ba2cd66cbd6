// SPDX-License-Identifier: MIT
#include "Suite.h"

namespace suite
{

namespace
{

const char* const roomsWalls = "what comes in comes by a window, which few of the lights see; a texel of light leaks where walls meet";
const char* const atriumsRoof = "light leaks by a texel where its walls stand on floors, into what is all but black";
const char* const thinLegs = "legs a pixel wide, beside which the rasteriser and a ray may see another one";

}  // namespace

const std::vector<Row>& rows()
{
    static const std::vector<Row> table = {
        {"wall", "sky"},
        {"wall", "studio"},
        {"wall", "courtyard"},
        {"wall", "interior"},
        {"post", "sky"},
        {"post", "studio"},
        {"post", "courtyard"},
        {"post", "interior"},
        {"room", "sky", roomsWalls},
        {"room", "studio", roomsWalls},
        {"room", "courtyard", roomsWalls},
        {"room", "interior", roomsWalls},
        {"stairs", "sky"},
        {"stairs", "studio"},
        {"stairs", "courtyard"},
        {"stairs", "interior"},
        {"canopy", "sky"},
        {"canopy", "studio"},
        {"canopy", "courtyard"},
        {"canopy", "interior"},
        {"foliage", "sky"},
        {"foliage", "studio"},
        {"foliage", "courtyard"},
        {"foliage", "interior"},
        {"gloss", "sky"},
        {"gloss", "studio"},
        {"gloss", "courtyard"},
        {"gloss", "interior"},
        {"knot", "sky"},
        {"knot", "studio"},
        {"knot", "courtyard"},
        {"knot", "interior"},
        {"chess", "sky"},
        {"chess", "studio"},
        {"chess", "courtyard"},
        {"chess", "interior"},
        {"atrium", "sky", atriumsRoof},
        {"atrium", "studio", atriumsRoof},
        {"atrium", "courtyard", atriumsRoof},
        {"atrium", "interior", atriumsRoof},
        {"swing", "sky"},
        {"swing", "studio"},
        {"swing", "courtyard"},
        {"swing", "interior"},
        {"spheres", "studio"},
        {"spider", "sky", thinLegs},
        {"spider", "studio", thinLegs},
        {"spider", "courtyard", thinLegs},
        {"spider", "interior", thinLegs},
        {"wuson", "sky"},
        {"wuson", "studio"},
        {"wuson", "courtyard"},
        {"wuson", "interior"},
        {"fels", "sky"},
        {"fels", "studio"},
        {"fels", "courtyard"},
        {"fels", "interior"},
        {"post", "lamps", "", {"two_sides"}},
        {"gloss", "sunset", "", {"turned", 110.0}},
        {"stairs", "forest", "", {"parallel", 0.0, true}},
        {"canopy", "sky", "", {"screen", 0.0, false, {{"visibility", 1}, {"occlusionSteps", 64}, {"occlusionLights", 2048}}}},
    };
    return table;
}

}  // namespace suite
