/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/StageDraw.h"

#include <functional>

namespace osgEnvLight
{

/** A stage that calls back, once, when the whole view has been culled: then the lights of all LightSources are known, also of
 * those behind it in the graph. */
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
};

}  // namespace osgEnvLight
