/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/DirectionalLight>
#include <osgEnvLight/Export>

#include <vector>

namespace osgEnvLight
{

/** The solid angle [sr] of the directions that are nearer to each light than to the others, by counting 8192 points of a
 * spherical Fibonacci lattice: they sum to 4 pi; of 256 lights each errs by about a tenth. Lights of flux 0 have none. */
OSGENVLIGHT_EXPORT std::vector<double> solidAngles(const LightList& lights);

}  // namespace osgEnvLight
