// SPDX-License-Identifier: MIT
// Makes the table of linearly transformed cosines: surface/LtcTable.h.
#pragma once

#include <array>
#include <vector>

/** At one roughness and view angles from 0 to a right angle, `count` >= 2 of them: of the inverse of the lobe's matrix, over its
 * middle element, x.x, x.z, z.x and z.z, as lib/ltc.glsl's ltcOf() has them from the table. Lobes are those of least square
 * difference from GGX's with F = 1, times the cosine, both over their integrals above the horizon [area-lights.md 4].*/
std::vector<std::array<double, 4>> fitLtcRow(double roughness, int count);
