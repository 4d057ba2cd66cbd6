// SPDX-License-Identifier: MIT
#pragma once

/** Lets osgDB find our plugins beside the nodekit's library, wherever that was built or installed, after the places of
 * OSG_LIBRARY_PATH.*/
void addPluginPath();
