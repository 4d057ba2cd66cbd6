// SPDX-License-Identifier: MIT
#include "frame/SceneFacts.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace osgEnvLight
{

namespace
{

const unsigned mostAtlasLights = 1024;

bool isNothing(const SceneFacts& f)
{
    return f.surfaces.deferred == 0 && f.surfaces.litForward == 0;
}

Requirement decideLight(const SceneFacts& f, const Settings& s)
{
    Requirement light;
    // Under a black map it is there for the light that surfaces send each other, if there is any.
    const bool isDark = f.mapIsBlack && (!f.hasLamps() || s.bounce == Settings::BOUNCE_OFF);
    light.unless(!s.diffuse, "switched off").unless(isDark, "the map is black");
    light.unless(isNothing(f), "nothing to light");
    return light.unless(f.carrier.given && f.carrier.lights == 0, "the application's list has no lights");
}

Requirement decideSuns(const SceneFacts& f, const Settings& s)
{
    const bool glossy = f.surfaces.hasLobes() || f.surfaces.litForward > 0;
    Requirement suns;
    suns.unless(s.suns == Settings::SUNS_OFF, "switched off").unless(f.mapIsBlack, "the map is black");
    suns.unless(isNothing(f), "nothing to light").unless(f.suns.count == 0, "the map has none");
    return suns.unless(s.suns == Settings::SUNS_GLOSSY && !glossy, "no glossy surface in view");
}

std::string describeSuns(const SunShare& suns, bool diffuse)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::fixed << std::setprecision(1) << suns.count << " with " << 100.0 * suns.share << " % of the map's flux, "
        << (diffuse ? "in D and S" : "in S");
    return out.str();
}

Requirement decideSunMaps(const SceneFacts& f, const Settings& s, const Requirement& suns)
{
    Requirement maps = suns;
    maps.unless(!s.occlusion, "occlusion is off").unless(s.visibility == Settings::VISIBILITY_NONE, "visibility is none");
    maps.unless(f.casters == 0, "nothing casts shadows");
    const std::string side = std::to_string(s.sunShadowSize);
    return maps.because("maps of " + side + " x " + side + " of " + counted(f.casters, "drawable") + ", drawn when they change");
}

Requirement decideAverage(const SceneFacts& f, const Settings& s)
{
    Requirement average;
    average.unless(s.antialias != Settings::ANTIALIAS_TEMPORAL, "frames stand for themselves");
    average.unless(s.view != Settings::BEAUTY, "an intermediate is shown");
    average.unless(s.output == Settings::LINEAR, "the host gets linear radiance, pixel by pixel");
    return average.unless(f.surfaces.deferred == 0, f.whyNoneIsDeferred());
}

// What keeps the map's light from a surface, whoever says so.
Requirement decideHidden(const SceneFacts& f, const Settings& s, const Decisions& d)
{
    Requirement hidden;
    hidden.unless(!s.occlusion, "switched off").unless(!d.light.needed, "there is no diffuse term to occlude");
    hidden.unless(s.visibility == Settings::VISIBILITY_NONE, "visibility is none");
    hidden.unless(!(f.sceneRadius > 0.0), "the scene has no extent");
    return hidden.unless(d.sunDiffuse && f.suns.share > 1.0 - 1e-6, "the suns are all of the map's light");
}

Requirement decideAtlas(const SceneFacts& f, const Settings& s, const Requirement& hidden)
{
    Requirement atlas = hidden;
    atlas.unless(s.visibility == Settings::VISIBILITY_SCREEN, "visibility is screen");
    atlas.unless(f.casters == 0, "nothing casts shadows");
    return atlas.unless(f.carrier.given && f.carrier.lights > mostAtlasLights,
                        "the application's list has more than 1024 lights");
}

Requirement decideOcclusion(const SceneFacts& f, const Settings& s, const Requirement& hidden, bool atlas)
{
    Requirement occlusion = hidden;
    occlusion.unless(f.surfaces.deferred == 0, f.whyNoneIsDeferred());
    occlusion.unless(!atlas && s.visibility == Settings::VISIBILITY_ATLAS, "there is no atlas to ask");
    return occlusion.unless(!atlas && s.occlusionRadius <= 0.0f, "occlusionRadius is 0");
}

std::string describeOcclusion(const Settings& s, const Decisions& d)
{
    const std::string slices = counted(size_t(d.atlas.needed ? s.nearSlices : s.occlusionSlices), "slice") + " of ";
    std::string reason = counted(d.occlusionLights, "light") + ", " + std::to_string(d.occlusionLights / 16) + " a pixel, ";
    if (d.atlas.needed)
        reason += d.screen ? "each asking its shadow map and " + slices + counted(size_t(2 * s.nearTaps), "tap")
                           : std::string("each asking its shadow map");
    else if (s.occlusionMethod == Settings::RAY)
        reason += counted(size_t(s.occlusionSteps), "point") + " a ray";
    else if (s.occlusionMethod == Settings::POINT)
        reason += "one point a ray";
    else
        reason += slices + counted(size_t(2 * s.occlusionTaps), "tap");
    if (d.occlusionLights != d.askedOcclusionLights) reason += " (rounded up to a multiple of 16)";
    return reason;
}

}  // namespace

const char* SceneFacts::whyNoneIsDeferred() const
{
    return surfaces.litForward > 0 ? "nothing to light but transparent surfaces" : "nothing to light";
}

bool Decisions::wantsAtlas(const Settings& s)
{
    return s.diffuse && s.occlusion && s.visibility != Settings::VISIBILITY_SCREEN && s.visibility != Settings::VISIBILITY_NONE;
}

bool Decisions::wantsSunMaps(const Settings& s)
{
    return (s.diffuse || s.specular) && s.occlusion && s.visibility != Settings::VISIBILITY_NONE && s.suns != Settings::SUNS_OFF;
}

bool Decisions::wantsEmitterMaps(const Settings& s)
{
    return (s.diffuse || s.specular) && s.occlusion && s.visibility != Settings::VISIBILITY_NONE;
}

bool Decisions::wantsAverage(const Settings& s)
{
    return s.antialias == Settings::ANTIALIAS_TEMPORAL && s.view == Settings::BEAUTY && s.output == Settings::DISPLAY;
}

Decisions Decisions::make(const SceneFacts& f, const Settings& s)
{
    Decisions d;
    d.light = decideLight(f, s);
    d.average = decideAverage(f, s);
    d.suns = decideSuns(f, s);
    d.sunDiffuse = d.suns.needed && s.suns == Settings::SUNS_AUTO && !f.carrier.given;  // whose list has them
    d.suns.because(describeSuns(f.suns, d.sunDiffuse));
    d.sunMaps = decideSunMaps(f, s, d.suns);
    const Requirement hidden = decideHidden(f, s, d);
    d.atlas = decideAtlas(f, s, hidden);
    d.occlusion = decideOcclusion(f, s, hidden, d.atlas.needed);
    d.screen = d.occlusion.needed && (!d.atlas.needed || (s.visibility != Settings::VISIBILITY_ATLAS && s.nearRadius > 0.0f));
    d.askedOcclusionLights = f.carrier.given ? f.carrier.lights : unsigned(d.atlas.needed ? s.atlasLights : s.occlusionLights);
    if (d.occlusion.needed || d.atlas.needed) d.occlusionLights = (d.askedOcclusionLights + 15) / 16 * 16;
    d.occlusion.because(describeOcclusion(s, d));
    d.atlas.because(counted(d.occlusionLights, "map") + " of " + std::to_string(s.atlasSize) + " x " +
                    std::to_string(s.atlasSize) + " of " + counted(f.casters, "drawable"));
    return d;
}

std::string counted(size_t n, const char* noun)
{
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace osgEnvLight
