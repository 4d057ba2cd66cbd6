// SPDX-License-Identifier: MIT
#include <osgEnvLight/Settings>

namespace osgEnvLight
{

const std::vector<Settings::Preset>& Settings::presets()
{
    static const std::vector<Preset> all = {
        {"low",
         "a slow machine: about half of the time is saved, the error a third to two thirds greater, edges are staircases",
         {{"atlasLights", "64"},
          {"nearRadius", "0"},
          {"filterCells", "1"},
          {"diffuseError", "1"},
          {"specularMethod", "prefiltered"},
          {"reflections", "indirect"},
          {"antialias", "off"},
          {"sunShadowSize", "512"},
          {"areaPoints", "32"},
          {"manyLights", "points"},
          {"bounce", "mean"}}},
        {"default", "the knee of error against time", {}},
        {"high",
         "stills and fast machines: sharper shadows, cleaner reflections, caustics of polished metal",
         {{"atlasSize", "256"},
          {"specularSamples", "64"},
          {"sunShadowSize", "2048"},
          {"bounceProbes", "16"},
          {"bounceNear", "on"},
          {"caustics", "auto"}}},
        {"interior",
         "rooms, into which little of the map shines: more of its lights, more probes of the light between walls",
         {{"atlasLights", "512"}, {"atlasSize", "256"}, {"bounceProbes", "16"}}},
    };
    return all;
}

bool Settings::setPreset(const std::string& name, std::string& error)
{
    const Preset* chosen = nullptr;
    for (const Preset& p : presets())
        if (name == p.name) chosen = &p;
    if (!chosen) {
        error = "preset is '" + name + "', expected";
        for (const Preset& p : presets()) error += std::string(&p == &presets().front() ? " " : " | ") + p.name;
        return false;
    }
    const osg::ref_ptr<Settings> usual = new Settings;
    for (const Preset& p : presets())
        for (const auto& [property, value] : p.values) find(property)->put(*this, find(property)->get(*usual));
    for (const auto& [property, value] : chosen->values)
        if (!set(property, value, error)) return false;
    return true;
}

}  // namespace osgEnvLight
