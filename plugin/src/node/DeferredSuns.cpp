// SPDX-License-Identifier: MIT
// The suns' shadow maps of a view: when they are drawn, and what each pixel sees of the suns.
#include "node/DeferredTechnique.h"

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

void DeferredTechnique::addSunMaps(Cull& c, osgUtil::CullVisitor& cv)
{
    const FramePlan& plan = c.view.plan;
    _drawnSunMaps = 0;
    if (!plan.sunMaps && !(c.away && FramePlan::wantsSunShadows(c.settings))) c.view.dropSunShadows();
    if (!plan.sunMaps || !c.asksSunMaps()) return;
    const ShadowView view{c.worldFromEye, *cv.getProjectionMatrix(), c.view.height()};
    const auto size = unsigned(c.settings.sunShadowSize);
    const VisibleBoxes boxes(c.casters, view);
    const unsigned levels = SunShadows::wantedLevels(boundOf(c.casters), view, boxes, size);
    SunShadows& shadows = c.view.sunShadows(plan.suns, levels, size);
    const DominantLights suns = inWorld(c, c.view.textures().suns());
    const std::vector<ShadowRefresh> refreshes = shadows.update(c.casters, suns, view, boxes);
    _drawnSunMaps = unsigned(refreshes.size());
    if (refreshes.empty()) return;

    addRefresh(c, cv, "sunmap", "pass/sunmap.frag", c.view.sunCamera(), shadows.targets(), refreshes,
               std::vector<Caster>(shadows.casters()));
}

void DeferredTechnique::addSunShadows(Cull& c, osgUtil::CullVisitor& cv, Target& seen, Target& visibility)
{
    SunShadows& shadows = *c.view.sunShadows();
    const ShadowPlaces places{&c.frame.sunState(shadows), shadows.targets().origin};
    for (const bool filter : {false, true}) {
        PassInputs in;
        in.samplers = {{"sunShadowMaps", shadows.texture()}, {"emissionMap", c.gbuffer.emission.get()}};
        static const char* const names[] = {"sunSeenMap0", "sunSeenMap1", "sunSeenMap2", "sunSeenMap3"};
        for (size_t i = 0; filter && i < 4; ++i)
            in.samplers.push_back({names[i], seen.textures[std::min(i, seen.textures.size() - 1)].get()});
        const char* name = filter ? "sunfilter" : "sunshadow";
        c.view.textures().addSuns(in.uniforms);
        addPass(c, cv, name, filter ? visibility : seen, passState(c, name, in), places);
    }
}

void DeferredTechnique::addSunVisibility(Cull& c, PassInputs& in)
{
    Target& visibility = c.view.target("sunfilter", {});
    in.defines.push_back("HAS_SUN_SHADOWS");
    in.samplers.push_back({"sunVisibilityMap0", visibility.textures.front().get()});
    in.samplers.push_back({"sunVisibilityMap1", visibility.textures.back().get()});
}

}  // namespace osgEnvLight
