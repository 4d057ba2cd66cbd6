/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

namespace osgEnvLight
{

/** How far a sampling tile's point is moved from its vertex, in the tile's own frame and scale: by importance index and
 * structural index. Zeros leave the points where they are.*/
struct PenroseTable {
    float shift[21][21][2];
};

/** Made by relaxation of points of flat importance: plugin/tables. */
extern OSGENVLIGHT_EXPORT const PenroseTable penroseTable;

}  // namespace osgEnvLight
