// SPDX-License-Identifier: MIT
// Makes the table of corrections of the Penrose points: osgEnvLight/PenroseTable.
#pragma once

#include <osgEnvLight/PenroseTable>

/** By Lloyd's relaxation [1982] of points of flat importance, each way to a Voronoi cell's centroid averaged over the points of
 * one structural index, in their tiles' frames; for each of the importances between two levels of subdivision.*/
osgEnvLight::PenroseTable relaxedPenroseTable();
