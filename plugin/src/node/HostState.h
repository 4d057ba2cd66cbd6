/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/ViewData.h"
#include "surface/SurfaceSorter.h"

#include <functional>
#include <string>

namespace osgEnvLight
{

/** Find out what is behind the scene: the map, or what the host has drawn there. Sets background and behind. */
void chooseBackground(FrameContext& context, const std::vector<ForwardGraph>& forward);

/** Find the application's lights. Sets lights, and lets the G-buffer's stage find those of LightSources behind the node when the
 * host has culled them.
 * @param report  receives what is not lit as without us */
void findLights(FrameContext& context, ViewData& view, const std::vector<ForwardGraph>& forward,
                const std::function<void(const std::string&)>& report);

/** Find the area lights that the cull has met.
 * @param report  receives which can not light, and why */
void findAreaLights(FrameContext& context, ViewData& view, const std::function<void(const std::string&)>& report);

/** Put the ground of Settings::ground below the scene, before that is culled. */
void placeGround(FrameContext& context, ViewData& view, osg::Group& node, SurfaceFacts& facts);

/** Find what casts shadows below the node, where a pass asks for it, and of that the lamps, which join the area lights.
 * @param sunny   whether there may be shadow maps of suns
 * @param report  receives how many lamps are left out */
void findCasters(FrameContext& context, ViewData& view, osg::Group& node, SurfaceFacts& facts, bool sunny,
                 const std::function<void(const std::string&)>& report);

/** Whether D of the map or of what the scene sends on is to be shown. */
bool needsCarrier(const FrameContext& context);

}  // namespace osgEnvLight
