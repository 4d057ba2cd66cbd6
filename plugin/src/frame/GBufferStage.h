/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/StageDraw.h"

#include <functional>

namespace osgEnvLight
{

/** A stage that calls back, once, when the whole view has been culled: then the lights of all LightSources are known, also of
 * those behind it in the graph. It starts from the state of a frame's start. */
class GBufferStage : public DrawnStage
{
  public:
    std::function<void()> afterCull;

    void sort() override
    {
        DrawnStage::sort();
        if (afterCull) afterCull();
        afterCull = nullptr;
    }

    // The state of the last pass before it is taken back first: the application's drawables find texture unit 0 active.
    void drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) override
    {
        osg::State& state = *renderInfo.getState();
        state.popAllStateSets();
        state.apply();
        state.setActiveTextureUnit(0);
        previous = nullptr;
        DrawnStage::drawImplementation(renderInfo, previous);
    }
};

}  // namespace osgEnvLight
