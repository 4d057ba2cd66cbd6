/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"
#include "surface/Emitter.h"

#include <vector>

namespace osgEnvLight
{

/** Lights that together send what a mesh with radiance 1 sends [area-lights.md 5]. A ball becomes a sphere. A body with a few
 * flat parts becomes rectangles, discs and polygons. Any other body becomes up to 32 rectangles, which touch it from outside.
 * Each light has the radiance by which the flux is that of the mesh.
 * @param bothSides  open bodies with flat parts send to both sides, as what is drawn without face culling does */
OSGENVLIGHT_EXPORT std::vector<Emitter> shapesOf(const CasterMesh& mesh, bool bothSides);

}  // namespace osgEnvLight
