/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/ViewData.h"
#include "passes/GBufferPass.h"

namespace osgEnvLight
{

/** A view with the passes of the lighting. A new pass is registered in its constructor. */
class LitView : public ViewData
{
  public:
    LitView(Failure* failure, RetiredObjects* retired, SurfaceSorter* sorter);

    const osg::ref_ptr<GBufferPass> gbufferPass;
};

}  // namespace osgEnvLight
