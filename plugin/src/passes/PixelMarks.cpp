// SPDX-License-Identifier: MIT
#include "passes/PixelMarks.h"

#include "passes/Inputs.h"

namespace osgEnvLight
{

Requirement PixelMarksPass::require(const FrameContext& c) const
{
    Requirement marks;
    marks.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return marks.because("which pixels the other passes have to draw");
}

void PixelMarksPass::setup(PassBuilder& b, FrameContext& c)
{
    b.read("specular properties", "specularMap");
    b.read("depth", "depthMap");
    b.defineKinds(c.facts.surfaces.lobes);
    if (c.facts.surfaces.hasLobes()) {
        b.define("HAS_LOBES");
        b.read("normal", "normalMap");
    }
    b.mark(b.create("pixel marks", {GL_DEPTH_COMPONENT16}));
}

}  // namespace osgEnvLight
