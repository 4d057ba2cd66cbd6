// SPDX-License-Identifier: MIT
#include "frame/DepthProbePass.h"

namespace osgEnvLight
{

void DepthProbePass::drawImplementation(osg::RenderInfo& renderInfo) const
{
    FullScreen::drawImplementation(renderInfo);
    buffer->exchange(*renderInfo.getState());
}

}  // namespace osgEnvLight
