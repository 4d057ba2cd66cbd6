// SPDX-License-Identifier: MIT
#include "Sweeps.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace tradeoff
{

namespace
{

using osgEnvLight::Settings;

struct Sweep {
    const char* name;
    std::vector<const char*> values;
    Texts with;  // what the knob needs to have an effect
    enum Where { ANY, SPECULAR, AREA_LIGHTS, FULL_TRANSPORT } where;
    bool alsoQuick;
};

const std::vector<Sweep>& defaultSweeps()
{
    static const std::vector<Sweep> sweeps = {
        {"visibility", {"screen", "atlas", "both"}, {}, Sweep::ANY, true},
        {"atlasLights", {"16", "64", "128", "256", "512", "1024"}, {}, Sweep::ANY, true},
        {"atlasSize", {"32", "64", "128", "256"}, {}, Sweep::ANY, true},
        {"sunShadowSize", {"256", "512", "1024", "2048"}, {}, Sweep::ANY, false},
        {"areaPoints", {"16", "32", "64", "128", "256"}, {}, Sweep::AREA_LIGHTS, true},
        {"manyLights", {"points", "lightcuts"}, {}, Sweep::AREA_LIGHTS, false},
        {"lightCutError", {"0", "0.02", "0.05", "0.1", "0.3", "1"}, {}, Sweep::AREA_LIGHTS, false},
        {"areaMapSize", {"32", "64", "128", "256"}, {}, Sweep::AREA_LIGHTS, false},
        {"nearRadius", {"0", "1", "2", "3", "6"}, {}, Sweep::ANY, false},
        {"nearSlices", {"1", "2", "4"}, {}, Sweep::ANY, false},
        {"nearTaps", {"2", "4", "8"}, {}, Sweep::ANY, false},
        {"occlusionLights", {"64", "128", "256", "512", "1024", "2048"}, {{"visibility", "screen"}}, Sweep::ANY, false},
        {"occlusionSteps", {"2", "4", "8", "16", "32", "64"}, {{"visibility", "screen"}}, Sweep::ANY, false},
        {"occlusionMethod", {"slice", "ray", "point", "gtao", "bent-normal"}, {{"visibility", "screen"}}, Sweep::ANY, false},
        {"occlusionSlices", {"1", "2", "4"}, {{"visibility", "screen"}, {"occlusionMethod", "slice"}}, Sweep::ANY, false},
        {"occlusionTaps",
         {"2", "4", "8", "16", "32"},
         {{"visibility", "screen"}, {"occlusionMethod", "slice"}},
         Sweep::ANY,
         false},
        {"occlusionRadius", {"0.0625", "0.125", "0.25", "0.5", "1"}, {{"visibility", "screen"}}, Sweep::ANY, false},
        {"occlusionThickness", {"0.05", "0.1", "0.2", "0.5", "1000"}, {{"visibility", "screen"}}, Sweep::ANY, false},
        {"filterCells", {"1", "2", "3", "4"}, {}, Sweep::ANY, false},
        {"combine", {"ratio", "subtract"}, {}, Sweep::ANY, false},
        {"diffuseCarrier", {"auto", "sh", "lights"}, {}, Sweep::ANY, false},
        {"diffuseLights", {"16", "32", "64", "128", "256", "512"}, {{"diffuseCarrier", "lights"}}, Sweep::ANY, false},
        {"lightSampler",
         {"auto", "split", "median-cut", "structured", "penrose", "inverse-cdf"},
         {{"diffuseCarrier", "lights"}},
         Sweep::ANY,
         false},
        {"suns", {"off", "glossy", "auto"}, {}, Sweep::ANY, false},
        {"specularMethod", {"sampled", "prefiltered"}, {}, Sweep::SPECULAR, true},
        {"specularSamples", {"4", "8", "16", "32", "64", "128"}, {}, Sweep::SPECULAR, true},
        {"reflections", {"off", "map", "indirect", "screen", "scene"}, {}, Sweep::FULL_TRANSPORT, true},
        {"reflectionSteps", {"4", "8", "16", "32", "64"}, {}, Sweep::SPECULAR, false},
        {"bounce", {"off", "mean", "probes"}, {}, Sweep::FULL_TRANSPORT, true},
        {"bounceProbes", {"4", "6", "8", "12", "16"}, {}, Sweep::FULL_TRANSPORT, false},
        {"bounceNear", {"off", "auto", "on"}, {}, Sweep::FULL_TRANSPORT, false},
        {"bounceNearDistance", {"0.25", "0.5", "1", "2"}, {}, Sweep::FULL_TRANSPORT, false},
    };
    return sweeps;
}

// Whether a setting says what surfaces send each other, which direct light is without.
bool isOfFullTransport(const std::string& name)
{
    return std::any_of(defaultSweeps().begin(), defaultSweeps().end(),
                       [&](const Sweep& s) { return name == s.name && s.where == Sweep::FULL_TRANSPORT; });
}

// The defaults first: what the others are held against.
std::vector<Candidate> presets(bool full)
{
    std::vector<Candidate> all = {{"preset", "default", unknown, {}},
                                  {"preset", "no occlusion", unknown, {{"occlusion", "off"}}}};
    for (const Settings::Preset& p : Settings::presets()) {
        if (p.values.empty()) continue;
        all.push_back({"preset", p.name, unknown, {}});
        for (const auto& [property, value] : p.values)
            if (full || !isOfFullTransport(property)) all.back().settings.emplace_back(property, value);
    }
    return all;
}

// Of a default sweep, which this selection may lack.
bool isKnob(const std::string& name)
{
    return std::any_of(defaultSweeps().begin(), defaultSweeps().end(), [&](const Sweep& s) { return name == s.name; });
}

double numberOf(const std::string& text)
{
    double number = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    return status == std::errc() && end == text.data() + text.size() ? number : unknown;
}

void addSweep(const std::string& name, const std::vector<std::string>& values, const Texts& with, std::vector<Candidate>& result)
{
    const osg::ref_ptr<Settings> trial = new Settings;
    for (const std::string& value : values) {
        Candidate c{name, value, numberOf(value), with};
        c.settings.emplace_back(name, value);
        std::string error;
        if (!trial->set(name, value, error)) throw std::invalid_argument("--sweep: " + error);
        result.push_back(c);
    }
}

// Of n in a row: the ends, the middle, the middles of the halves, ...
std::vector<size_t> coarseToFine(size_t n)
{
    std::vector<size_t> order;
    if (n == 0) return order;
    order.push_back(0);
    if (n == 1) return order;
    order.push_back(n - 1);
    std::vector<std::pair<size_t, size_t>> gaps = {{0, n - 1}};
    for (size_t i = 0; i < gaps.size(); ++i) {
        const auto [low, high] = gaps[i];
        if (high - low < 2) continue;
        const size_t middle = (low + high) / 2;
        order.push_back(middle);
        gaps.emplace_back(low, middle);
        gaps.emplace_back(middle, high);
    }
    return order;
}

}  // namespace

std::pair<std::string, std::vector<std::string>> parseSweep(const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw std::invalid_argument("--sweep is '" + text + "', expected name=value,value,...");
    std::vector<std::string> values;
    for (size_t from = equals + 1; from <= text.size();) {
        const size_t comma = std::min(text.find(',', from), text.size());
        if (comma == from) throw std::invalid_argument("--sweep is '" + text + "', in which a value is missing");
        values.push_back(text.substr(from, comma - from));
        from = comma + 1;
    }
    if (values.empty()) throw std::invalid_argument("--sweep is '" + text + "', in which a value is missing");
    return {text.substr(0, equals), values};
}

std::vector<Candidate> candidates(const Selection& selection)
{
    std::vector<Candidate> all = presets(selection.full);
    for (const Sweep& s : defaultSweeps()) {
        const bool replaced =
            std::any_of(selection.sweeps.begin(), selection.sweeps.end(), [&](const auto& a) { return a.first == s.name; });
        if (replaced || (selection.quick && !s.alsoQuick) || (s.where == Sweep::SPECULAR && !selection.specular) ||
            (s.where == Sweep::AREA_LIGHTS && !selection.areaLights) || (s.where == Sweep::FULL_TRANSPORT && !selection.full))
            continue;
        std::vector<std::string> values(s.values.begin(), s.values.end());
        if (selection.quick)
            for (size_t i = 1; i < values.size(); ++i) values.erase(values.begin() + ptrdiff_t(i));
        addSweep(s.name, values, s.with, all);
    }
    for (const auto& [name, values] : selection.sweeps) {
        Texts with;
        for (const Sweep& s : defaultSweeps())
            if (name == s.name) with = s.with;
        addSweep(name, values, with, all);
    }
    if (selection.only.empty()) return all;
    std::vector<Candidate> result = {all[0]};
    for (const std::string& name : selection.only) {
        bool found = false;
        for (const Candidate& c : all) {
            if (c.sweep != name && (c.sweep != "preset" || c.value != name)) continue;
            found = true;
            if (&c != &all[0]) result.push_back(c);
        }
        if (!found && !isKnob(name)) throw std::invalid_argument("--only: no preset and no sweep is named '" + name + "'");
    }
    return result;
}

std::vector<size_t> measuringOrder(const std::vector<Candidate>& all)
{
    std::vector<size_t> order;
    std::vector<std::vector<size_t>> sweeps;
    size_t rounds = 0;
    for (size_t from = 0, to = 0; from < all.size(); from = to) {
        while (to < all.size() && all[to].sweep == all[from].sweep) ++to;
        if (all[from].sweep == "preset") {
            for (size_t i = from; i < to; ++i) order.push_back(i);
            continue;
        }
        sweeps.push_back(coarseToFine(to - from));
        for (size_t& i : sweeps.back()) i += from;
        rounds = std::max(rounds, to - from);
    }
    for (size_t round = 0; round < rounds; ++round)
        for (const std::vector<size_t>& sweep : sweeps)
            if (round < sweep.size()) order.push_back(sweep[round]);
    return order;
}

void apply(const Candidate& candidate, const Settings& base, Settings& settings, Texts& changed)
{
    std::string error;
    for (const Settings::Property& p : Settings::table()) p.put(settings, p.get(base));
    for (const auto& [name, value] : candidate.settings)
        if (!settings.set(name, value, error)) throw std::invalid_argument(error);
    changed.clear();
    for (const Settings::Property& p : Settings::table())
        if (p.get(settings) != p.get(base)) changed.emplace_back(p.name, p.getString(settings));
}

}  // namespace tradeoff
