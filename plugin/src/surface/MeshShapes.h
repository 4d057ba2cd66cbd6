/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"
#include "surface/Emitter.h"

#include <vector>

namespace osgEnvLight
{

/** Lights that send what a mesh with radiance 1 would [area-lights.md 5]: its balls as spheres, bodies with a few flat parts by
 * these as rectangles, discs and polygons, and each other body as up to 32 rectangles. Those have the areas that parts of it show
 * and touch it from outside. What radiance they need to send as much as the body is in each.
 * @param bothSides  open bodies with flat parts send to both sides, as what is drawn without face culling does */
OSGENVLIGHT_EXPORT std::vector<Emitter> shapesOf(const CasterMesh& mesh, bool bothSides);

}  // namespace osgEnvLight
