// SPDX-License-Identifier: MIT
#include "passes/PixelMarks.h"

#include "passes/Inputs.h"

namespace osgEnvLight
{

Requirement PixelMarksPass::require(const FrameContext& c) const
{
    Requirement marks;
    const bool forward = c.facts.surfaces.litForward > 0;
    marks.unless(c.facts.surfaces.deferred == 0, forward ? Decisions::onlyForward : "nothing to light");
    return marks.because("which pixels the other passes have to draw");
}

void PixelMarksPass::setup(PassBuilder& b, FrameContext& c)
{
    b.read("specular properties", "specularMap");
    b.read("depth", "depthMap");
    b.define("HAS_LOBES", c.facts.surfaces.phong || c.facts.surfaces.cookTorrance);
    b.mark(b.create("pixel marks", {GL_DEPTH_COMPONENT16}));
}

}  // namespace osgEnvLight
