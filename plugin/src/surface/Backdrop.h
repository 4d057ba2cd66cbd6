/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/SurfaceSorter.h"

#include <osgUtil/RenderStage>

#include <string>
#include <vector>

namespace osgEnvLight
{

/** Whether something of the application's covers the far field, as a sky dome or a full-screen picture does: then
 * Settings::background = auto draws no map over it. Known are the drawables below the node and those that were culled before it
 * into negative bins of the same stage.
 * @param forward  what of the node's own drawables is drawn in the host's bins
 * @return         the backdrop in words; empty if there is none*/
OSGENVLIGHT_EXPORT std::string findBackdrop(osgUtil::RenderStage& host, const std::vector<ForwardGraph>& forward);

}  // namespace osgEnvLight
