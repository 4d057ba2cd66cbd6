// SPDX-License-Identifier: MIT
#include "passes/Lighting.h"

#include "base/Limits.h"
#include "passes/Inputs.h"

namespace osgEnvLight
{

Requirement DiffusePass::require(const FrameContext& c) const
{
    Requirement diffuse = c.decisions.light;
    diffuse.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return diffuse.because(c.facts.carrier.describe());
}

void DiffusePass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    readIrradiance(b, c);
    readLobes(b, c);
    drawSurfaces(b);
    b.write(b.create("diffuse"));
    if (!c.decisions.sunDiffuse) return;
    b.define("HAS_SUNS");
    readSuns(b, c);
    // A picture shows only what shadows leave of them. Shadow catchers divide by the whole.
    const bool isShaded = readSunVisibility(b);
    const bool keepsUnshaded = !isShaded || c.settings.view != Settings::BEAUTY || c.facts.surfaces.catchers > 0;
    b.define("UNSHADED_SUNS", keepsUnshaded);
    if (isShaded) b.write(b.create("sun shaded"));
    if (keepsUnshaded) b.write(b.create("sun diffuse"));
}

}  // namespace osgEnvLight
