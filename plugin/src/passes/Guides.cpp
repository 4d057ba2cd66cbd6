// SPDX-License-Identifier: MIT
#include "passes/Guides.h"

#include "base/Limits.h"
#include "passes/Gather.h"

namespace osgEnvLight
{

Requirement GuidesPass::require(const FrameContext& c) const
{
    return requireGather(c).because("the bright places that probes see, to which rays are aimed");
}

// What one of a still view's frames finds serves those that follow.
void GuidesPass::setup(PassBuilder& b, FrameContext& c)
{
    const bool found = _found;
    _found = c.isAccumulating();
    if (!_found) return;
    const IndirectLight& light = *c.indirect;
    const TextureId guides = b.create("guides", {GL_RGBA32UI_EXT, light.scene->columns + limits::GUIDE_ROWS, true});
    if (found) {
        b.keepContents();
        return;
    }
    b.bind(light.scene->pointPlaces, "pointPlaceMap");
    b.bind(light.scene->probeLinks, "probeLinkMap");
    b.bind(light.scene->probeBasis, "probeBasisMap");
    b.bind(light.targets.pointRadiance, "pointRadianceMap");
    b.frameUniforms(light.scene->uniforms);
    b.drawAlways();
    b.write(guides);
}

}  // namespace osgEnvLight
