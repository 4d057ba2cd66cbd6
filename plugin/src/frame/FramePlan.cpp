// SPDX-License-Identifier: MIT
#include "frame/FramePlan.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace osgEnvLight
{

namespace
{

// Runs unless one of the conditions, asked in order, forbids it.
struct Decision {
    bool runs = true;
    std::string reason;

    Decision& unless(bool condition, const char* why)
    {
        if (condition && runs) {
            runs = false;
            reason = why;
        }
        return *this;
    }
};

std::string count(unsigned n, const char* what)
{
    return std::to_string(n) + " " + what;
}

const unsigned mostAtlasLights = 1024;

}  // namespace

bool FramePlan::wantsAtlas(const Settings& s)
{
    return s.diffuse && s.occlusion && s.visibility != Settings::VISIBILITY_SCREEN && s.visibility != Settings::VISIBILITY_NONE;
}

bool FramePlan::wantsSunShadows(const Settings& s)
{
    return (s.diffuse || s.specular) && s.occlusion && s.visibility != Settings::VISIBILITY_NONE && s.suns != Settings::SUNS_OFF;
}

FramePlan FramePlan::make(const Settings& s, const SurfaceKinds& surfaces, bool mapIsBlack, double sceneRadius,
                          const DiffuseCarrier& carrier, const SunShare& suns, size_t casters, bool ownGBuffer)
{
    FramePlan plan;
    plan.surfaces = surfaces;
    const bool empty = surfaces.deferred == 0;
    const bool nothing = empty && surfaces.litForward == 0;
    const char* const onlyForward = "nothing to light but transparent surfaces";

    Decision light;
    light.unless(!s.diffuse, "switched off").unless(mapIsBlack, "the map is black").unless(nothing, "nothing to light");
    light.unless(carrier.given && carrier.lights == 0, "the application's list has no lights");
    Decision diffuse = light;
    diffuse.unless(empty, onlyForward);
    plan.diffuse = diffuse.runs;
    plan.diffuseHarmonics = diffuse.runs ? carrier.harmonics : 0;
    plan.diffuseLights = diffuse.runs ? carrier.lights : 0;
    if (diffuse.runs) diffuse.reason = carrier.describe();

    Decision sun;
    sun.unless(s.suns == Settings::SUNS_OFF, "switched off").unless(mapIsBlack, "the map is black");
    sun.unless(nothing, "nothing to light").unless(suns.count == 0, "the map has none");
    sun.unless(s.suns == Settings::SUNS_GLOSSY && !surfaces.phong && !surfaces.cookTorrance && surfaces.litForward == 0,
               "no glossy surface in view");
    plan.suns = sun.runs ? suns.count : 0;
    plan.sunDiffuse = sun.runs && s.suns == Settings::SUNS_AUTO && !carrier.given;  // whose list has them
    if (sun.runs) {
        std::ostringstream out;
        out.imbue(std::locale::classic());
        out << std::fixed << std::setprecision(1) << suns.count << " with " << 100.0 * suns.share << " % of the map's flux, "
            << (plan.sunDiffuse ? "in D and S" : "in S");
        sun.reason = out.str();
    }

    Decision maps = sun;
    maps.unless(!s.occlusion, "occlusion is off").unless(s.visibility == Settings::VISIBILITY_NONE, "visibility is none");
    maps.unless(casters == 0, "nothing casts shadows");
    plan.sunMaps = maps.runs;
    Decision shadows = maps;
    shadows.unless(empty, onlyForward);
    plan.sunShadows = shadows.runs;
    if (maps.runs) {
        const std::string side = std::to_string(s.sunShadowSize);
        maps.reason = "maps of " + side + " x " + side + " of " + std::to_string(casters) + " drawables, drawn when they change";
    }
    if (shadows.runs) shadows.reason = "2 points of each disc a pixel, 16 more in penumbrae";

    Decision specular;
    specular.unless(!s.specular, "switched off").unless(mapIsBlack, "the map is black").unless(empty, "nothing to light");
    specular.unless(!surfaces.phong && !surfaces.cookTorrance, "no glossy surface in view");
    plan.specular = specular.runs;
    if (specular.runs) specular.reason = count(unsigned(s.specularSamples), "samples a pixel");

    Decision hidden;
    hidden.unless(!s.occlusion, "switched off").unless(!light.runs, "there is no diffuse term to occlude");
    hidden.unless(s.visibility == Settings::VISIBILITY_NONE, "visibility is none");
    hidden.unless(!(sceneRadius > 0.0), "the scene has no extent");
    hidden.unless(plan.sunDiffuse && suns.share > 1.0 - 1e-6, "the suns are all of the map's light");

    Decision atlas = hidden;
    atlas.unless(s.visibility == Settings::VISIBILITY_SCREEN, "visibility is screen");
    atlas.unless(casters == 0, "nothing casts shadows");
    atlas.unless(carrier.given && carrier.lights > mostAtlasLights, "the application's list has more than 1024 lights");
    plan.atlas = atlas.runs;
    Decision occlusion = hidden;
    occlusion.unless(empty, onlyForward);
    occlusion.unless(!atlas.runs && s.visibility == Settings::VISIBILITY_ATLAS, "there is no atlas to ask");
    occlusion.unless(!atlas.runs && s.occlusionRadius <= 0.0f, "occlusionRadius is 0");
    plan.occlusion = occlusion.runs;
    plan.lobes = specular.runs && occlusion.runs && atlas.runs;
    if (plan.lobes) specular.reason += ", occluded by what the atlas knows";
    plan.screen = occlusion.runs && (!atlas.runs || (s.visibility != Settings::VISIBILITY_ATLAS && s.nearRadius > 0.0f));
    const unsigned asked = carrier.given ? carrier.lights : unsigned(atlas.runs ? s.atlasLights : s.occlusionLights);
    if (occlusion.runs || atlas.runs) plan.occlusionLights = (asked + 15) / 16 * 16;
    if (occlusion.runs) {
        const std::string taps = count(unsigned(s.occlusionSlices), "slices of ");
        occlusion.reason = count(plan.occlusionLights, "lights, ") + count(plan.occlusionLights / 16, "a pixel, ");
        if (atlas.runs)
            occlusion.reason += plan.screen ? "each asking its shadow map and " + taps + count(unsigned(2 * s.nearTaps), "taps")
                                            : std::string("each asking its shadow map");
        else if (s.occlusionMethod == Settings::RAY)
            occlusion.reason += count(unsigned(s.occlusionSteps), "points a ray");
        else if (s.occlusionMethod == Settings::POINT)
            occlusion.reason += "one point a ray";
        else
            occlusion.reason += taps + count(unsigned(2 * s.occlusionTaps), "taps");
        if (plan.occlusionLights != asked) occlusion.reason += " (rounded up to a multiple of 16)";
    }
    if (atlas.runs)
        atlas.reason = count(plan.occlusionLights, "maps of ") + std::to_string(s.atlasSize) + " x " +
                       std::to_string(s.atlasSize) + " of " + std::to_string(casters) + " drawables";

    Decision bounce;
    bounce.unless(s.bounce == Settings::BOUNCE_OFF, "switched off").unless(!occlusion.runs, "no light is blocked");
    bounce.unless(!atlas.runs, "without the atlas nobody knows how much of the map a surface sees");
    plan.bounce = bounce.runs;
    if (bounce.runs) bounce.reason = "mean radiance of the picture where light is blocked";

    Decision accumulate;
    accumulate.unless(!s.accumulate, "switched off").unless(s.view != Settings::BEAUTY, "an intermediate is shown");
    const std::string noAtlas = "without the atlas there is nothing to converge to: " + atlas.reason;
    accumulate.unless(!atlas.runs, noAtlas.c_str()).unless(empty, onlyForward);
    accumulate.unless(!ownGBuffer, "what the application's own G-buffer shows may move unseen");
    plan.accumulate = accumulate.runs;

    plan.passes = {{"gbuffer", true, count(surfaces.deferred, "drawables, ") + count(surfaces.forward, "drawn forward")},
                   {"suns", sun.runs, sun.reason},
                   {"sunmap", maps.runs, maps.reason},
                   {"sunshadow", shadows.runs, shadows.reason},
                   {"sunfilter", shadows.runs, shadows.runs ? "averages within penumbrae" : shadows.reason},
                   {"diffuse", diffuse.runs, diffuse.reason},
                   {"specular", specular.runs, specular.reason},
                   {"atlas", atlas.runs, atlas.reason},
                   {"occlusion", occlusion.runs, occlusion.reason},
                   {"filter", occlusion.runs, occlusion.runs ? "averages the 16 groups of lights" : occlusion.reason},
                   {"bounce", bounce.runs, bounce.reason},
                   {"accumulate", accumulate.runs, accumulate.runs ? "while nothing moves" : accumulate.reason},
                   {"composite", true, "into the host's colour and depth"}};
    return plan;
}

void FramePlan::decideSceneLights(const Settings& s, size_t count, bool ownGBuffer)
{
    Decision lights;
    lights.unless(s.sceneLights == Settings::SCENE_LIGHTS_OFF, "switched off");
    lights.unless(!ownGBuffer, "the application's own G-buffer says what surfaces emit");
    lights.unless(count == 0 && s.sceneLights == Settings::SCENE_LIGHTS_AUTO, "only the viewer's own light");
    lights.unless(count == 0, "no light is switched on");
    lights.unless(surfaces.deferred == 0, surfaces.litForward ? "nothing to light but transparent surfaces" : "nothing to light");
    sceneLights = lights.runs;
    if (lights.runs) lights.reason = std::to_string(count) + (count == 1 ? " light" : " lights") + ", without shadows";
    passes.insert(passes.begin() + 1, {"scenelights", lights.runs, lights.reason});  // after the G-buffer
}

Plan FramePlan::report() const
{
    return {passes, surfaces, diffuseLights, occlusionLights, suns};
}

}  // namespace osgEnvLight
