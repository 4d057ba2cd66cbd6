// SPDX-License-Identifier: MIT
// Makes the table of corrections of the Penrose points: osgEnvLight/PenroseTable.
#pragma once

#include "lights/PenroseTable.h"

/** One row, by Lloyd's relaxation [1982] of points of flat importance: each way to a Voronoi cell's centroid averaged over the
 * points of one structural index, in their tiles' frames.
 * @param density  0..20, between two levels of subdivision; whose row it is the points know*/
void relaxPenroseRow(unsigned density, osgEnvLight::PenroseTable& table);

/** All 21. */
osgEnvLight::PenroseTable relaxedPenroseTable();
