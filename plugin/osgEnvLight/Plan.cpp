// SPDX-License-Identifier: MIT
#include <osgEnvLight/Plan>

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

}  // namespace

Plan Plan::make(const Settings& s, const SurfaceKinds& surfaces, bool mapIsBlack, double sceneRadius,
                const DiffuseCarrier& carrier, const SunShare& suns)
{
    Plan plan;
    plan.surfaces = surfaces;
    const bool empty = surfaces.deferred == 0;

    Decision diffuse;
    diffuse.unless(!s.diffuse, "switched off").unless(mapIsBlack, "the map is black").unless(empty, "nothing to light");
    diffuse.unless(carrier.given && carrier.lights == 0, "the application's list has no lights");
    plan.diffuse = diffuse.runs;
    plan.diffuseHarmonics = diffuse.runs ? carrier.harmonics : 0;
    plan.diffuseLights = diffuse.runs ? carrier.lights : 0;
    if (diffuse.runs) diffuse.reason = carrier.describe();

    Decision sun;
    sun.unless(s.suns == Settings::SUNS_OFF, "switched off").unless(mapIsBlack, "the map is black");
    sun.unless(empty, "nothing to light").unless(suns.count == 0, "the map has none");
    sun.unless(s.suns == Settings::SUNS_GLOSSY && !surfaces.phong && !surfaces.cookTorrance && surfaces.forward == 0,
               "no glossy surface in view");
    plan.suns = sun.runs ? suns.count : 0;
    plan.sunDiffuse = sun.runs && s.suns == Settings::SUNS_AUTO;
    if (sun.runs) {
        std::ostringstream out;
        out.imbue(std::locale::classic());
        out << std::fixed << std::setprecision(1) << suns.count << " with " << 100.0 * suns.share << " % of the map's flux, "
            << (plan.sunDiffuse ? "in D and S" : "in S");
        sun.reason = out.str();
    }

    Decision specular;
    specular.unless(!s.specular, "switched off").unless(mapIsBlack, "the map is black").unless(empty, "nothing to light");
    specular.unless(!surfaces.phong && !surfaces.cookTorrance, "no glossy surface in view");
    plan.specular = specular.runs;
    if (specular.runs) specular.reason = count(unsigned(s.specularSamples), "samples a pixel");

    Decision occlusion;
    occlusion.unless(!s.occlusion, "switched off").unless(!diffuse.runs, "there is no diffuse term to occlude");
    occlusion.unless(s.occlusionRadius <= 0.0f, "occlusionRadius is 0").unless(!(sceneRadius > 0.0), "the scene has no extent");
    plan.occlusion = occlusion.runs;
    if (occlusion.runs) {
        const unsigned asked = carrier.given ? carrier.lights : unsigned(s.occlusionLights);
        plan.occlusionLights = (asked + 15) / 16 * 16;
        occlusion.reason = count(plan.occlusionLights, "lights, ") + count(plan.occlusionLights / 16, "a pixel, ") +
                           count(unsigned(s.occlusionSteps), "points a ray");
        if (plan.occlusionLights != asked) occlusion.reason += " (rounded up to a multiple of 16)";
    }

    plan.reasons = {{"gbuffer", true, count(surfaces.deferred, "drawables, ") + count(surfaces.forward, "drawn forward")},
                    {"suns", sun.runs, sun.reason},
                    {"diffuse", diffuse.runs, diffuse.reason},
                    {"specular", specular.runs, specular.reason},
                    {"occlusion", occlusion.runs, occlusion.reason},
                    {"filter", occlusion.runs, occlusion.runs ? "averages the 16 groups of lights" : occlusion.reason},
                    {"composite", true, "into the host's colour and depth"}};
    return plan;
}

std::string Plan::explain() const
{
    std::ostringstream out;
    for (const Reason& r : reasons) out << r.pass << ": " << (r.runs ? "" : "off, ") << r.reason << "\n";
    return out.str();
}

}  // namespace osgEnvLight
