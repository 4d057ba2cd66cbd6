// SPDX-License-Identifier: MIT
#include "DefineSets.h"

#include "gl/ShaderLibrary.h"

#include <osg/ref_ptr>

#include <algorithm>
#include <random>
#include <regex>

namespace
{

bool has(const Defines& set, const std::string& define)
{
    return std::find(set.begin(), set.end(), define) != set.end();
}

// Of each row at most one: an index or a switch chooses it. Occlusion::setup, Diffuse::setup, CompositePass::setup,
// SurfaceSort::variantBits, AreaLightsPass::setup.
const std::vector<Defines> alternatives = {
    {"OCCLUSION_SLICES", "OCCLUSION_RAYS", "OCCLUSION_POINTS", "OCCLUSION_HORIZONS", "OCCLUSION_BENT_NORMAL"},
    {"SLICES_1", "SLICES_2", "SLICES_3"},
    {"DIFFUSE_SH_9", "DIFFUSE_SH_18", "DIFFUSE_LIGHTS"},
    {"ACCUMULATED", "VIEW_TERM"},
    {"ANTIALIASED", "VIEW_TERM"},
    {"ACCUMULATED", "TEMPORAL"},
    {"VEIL_LINEAR", "BACKGROUND"},
    {"ADAPTED", "VIEW_TERM"},
    {"ADAPTED", "ANTIALIASED"},
    {"ADAPTED", "OUTPUT_LINEAR"},
    {"NO_TEXTURE", "TEXTURE_REPLACE", "TEXTURE_DECAL", "TEXTURE_BLEND", "TEXTURE_ADD"},
    {"TEXGEN_OBJECT", "TEXGEN_EYE"},
    {"HAS_AREA_POINTS", "HAS_LIGHT_CUTS"},
    {"ENVLIGHT_LAMBERT", "ENVLIGHT_PHONG", "ENVLIGHT_COOK_TORRANCE", "ENVLIGHT_STRAUSS", "ENVLIGHT_CATCHER"},
};

// The first only with the second, in programs that import both.
const std::vector<std::pair<std::string, std::string>> needs = {
    {"SUNS_OVER_4", "SUNS_OVER_2"},          {"SUNS_OVER_6", "SUNS_OVER_4"},  {"BACKGROUND_BLUR", "BACKGROUND"},
    {"HAS_OCCLUSION", "HAS_DIFFUSE"},        {"HAS_BOUNCE", "HAS_OCCLUSION"}, {"SUN_DIFFUSE", "HAS_SUNS"},
    {"HAS_NEIGHBOURHOOD", "HAS_ATLAS"},      {"TEMPORAL", "ANTIALIASED"},     {"HAS_LOBES", "HAS_ATLAS"},
    {"HAS_ANISOTROPY", "HAS_COOK_TORRANCE"}, {"HAS_BOUNCE", "HAS_ATLAS"},     {"HAS_PROBES", "HAS_ATLAS"},
    {"MAP_ON_GROUND", "HAS_CATCHERS"},       {"MAP_ON_GROUND", "BACKGROUND"},
    {"VEIL_LINEAR", "HAS_CATCHERS"},
    {"HAS_PROBE_LATTICES", "HAS_PROBES"},    {"HAS_UNLIT", "ADAPTED"},     {"HAS_SCENE_LIGHT_MAPS", "HAS_SCENE_LIGHTS"},
};

void extend(const Defines& defines, size_t next, Defines& set, std::vector<Defines>& result)
{
    if (next < defines.size()) {
        extend(defines, next + 1, set, result);
        const std::string& d = defines[next];
        for (const Defines& row : alternatives)
            if (has(row, d) && std::any_of(set.begin(), set.end(), [&](const std::string& s) { return has(row, s); })) return;
        set.push_back(d);
        extend(defines, next + 1, set, result);
        set.pop_back();
        return;
    }
    for (const auto& [define, other] : needs)
        if (has(set, define) && has(defines, other) && !has(set, other)) return;
    result.push_back(set);
}

// Lobes stand beside each other: a product has none or all of them; someSets() has each, and any three.
const Defines lobes = {"HAS_PHONG",      "HAS_COOK_TORRANCE", "HAS_BLINN_PHONG", "HAS_BECKMANN",     "HAS_STRAUSS",
                       "HAS_ANISOTROPY", "HAS_EDGES",         "HAS_COATS",       "HAS_ROUGH_DIFFUSE"};

std::vector<Defines> product(const Defines& defines)
{
    std::vector<Defines> result;
    Defines rest, present, set;
    for (const std::string& d : defines) (has(lobes, d) ? present : rest).push_back(d);
    extend(rest, 0, set, result);
    if (present.empty()) return result;
    const std::vector<Defines> without = result;
    for (Defines with : without) {
        with.insert(with.end(), present.begin(), present.end());
        result.push_back(with);
    }
    for (const Defines& some : someSets(defines)) result.push_back(some);
    return result;
}

// A surface's kind, how its texture joins, and one or all of what else it may have.
std::vector<Defines> surfaceSets(const Defines& surface)
{
    const Defines kinds = {"",
                           "UNLIT",
                           "PHONG_MATERIAL",
                           "PAINTED_REFLECTION",
                           "ENVLIGHT_LAMBERT",
                           "ENVLIGHT_PHONG",
                           "ENVLIGHT_COOK_TORRANCE",
                           "ENVLIGHT_STRAUSS",
                           "ENVLIGHT_CATCHER"};
    const Defines modes = {"", "NO_TEXTURE", "TEXTURE_REPLACE", "TEXTURE_DECAL", "TEXTURE_BLEND", "TEXTURE_ADD"};
    Defines others;
    for (const std::string& d : surface)
        if (!has(kinds, d) && !has(modes, d)) others.push_back(d);
    std::vector<Defines> result;
    for (const std::string& kind : kinds)
        for (const std::string& mode : modes) {
            Defines set;
            if (!kind.empty()) set.push_back(kind);
            if (!mode.empty()) set.push_back(mode);
            result.push_back(set);
            for (const std::string& d : others) {
                result.push_back(set);
                result.back().push_back(d);
            }
            set.insert(set.end(), others.begin(), others.end());
            result.push_back(set);
        }
    return result;
}

// Any three of the defines, and which of the eight ways to set them have occurred.
class Triples
{
  public:
    explicit Triples(size_t defines)
    {
        for (size_t i = 0; i < defines; ++i)
            for (size_t j = 0; j < i; ++j)
                for (size_t k = 0; k < j; ++k) _triples.push_back({i, j, k, 0});
    }

    // How many ways a choice of defines adds.
    size_t adds(const std::vector<bool>& chosen) const
    {
        size_t count = 0;
        for (const Triple& t : _triples) count += t.ways >> way(t, chosen) & 1 ? 0 : 1;
        return count;
    }
    void add(const std::vector<bool>& chosen)
    {
        for (Triple& t : _triples) t.ways |= 1u << way(t, chosen);
    }

  private:
    struct Triple {
        size_t a, b, c;
        unsigned ways;
    };

    static unsigned way(const Triple& t, const std::vector<bool>& chosen)
    {
        return 4u * chosen[t.a] + 2u * chosen[t.b] + chosen[t.c];
    }

    std::vector<Triple> _triples;
};

}  // namespace

Defines imported(const std::string& text)
{
    static const std::regex pragma("#pragma import_defines\\(([^)]*)\\)");
    static const std::regex word("\\w+");
    Defines result;
    for (std::sregex_iterator p(text.begin(), text.end(), pragma), none; p != none; ++p) {
        const std::string list = (*p)[1].str();
        for (std::sregex_iterator w(list.begin(), list.end(), word); w != none; ++w)
            if (!has(result, w->str())) result.push_back(w->str());
    }
    return result;
}

std::vector<Defines> tripleSets(const Defines& defines)
{
    std::vector<Defines> result;
    Triples triples(defines.size());
    std::mt19937 random(1);
    std::vector<bool> chosen(defines.size());
    for (size_t most = 1; most > 0;) {
        most = 0;
        for (int candidate = 0; candidate < 16 || (most == 0 && candidate < 256); ++candidate) {
            std::vector<bool> other(defines.size());
            for (size_t i = 0; i < other.size(); ++i) other[i] = random() & 1;
            const size_t adds = triples.adds(other);
            if (adds <= most) continue;
            most = adds;
            chosen = other;
        }
        if (most == 0) break;
        triples.add(chosen);
        result.push_back({});
        for (size_t i = 0; i < chosen.size(); ++i)
            if (chosen[i]) result.back().push_back(defines[i]);
    }
    return result;
}

std::vector<Defines> someSets(const Defines& defines)
{
    std::vector<Defines> result;
    if (defines.size() <= 5) {
        for (size_t bits = 0; bits < (size_t(1) << defines.size()); ++bits) {
            Defines set;
            for (size_t i = 0; i < defines.size(); ++i)
                if (bits >> i & 1) set.push_back(defines[i]);
            result.push_back(set);
        }
        return result;
    }
    result = tripleSets(defines);
    result.push_back({});
    result.push_back(defines);
    for (size_t i = 0; i < defines.size(); ++i) {
        result.push_back({defines[i]});
        Defines others = defines;
        others.erase(others.begin() + std::ptrdiff_t(i));
        result.push_back(others);
    }
    return result;
}

std::vector<Defines> reachableSets(const Defines& defines)
{
    const osg::ref_ptr<osgEnvLight::ShaderLibrary> library = new osgEnvLight::ShaderLibrary(nullptr);
    const Defines all = imported(library->expand("pass/surface.glsl").text);
    Defines frame;
    for (const std::string& d : defines)
        if (!has(all, d)) frame.push_back(d);
    if (defines.size() < frame.size() + all.size()) return product(defines);
    std::vector<Defines> result = someSets(defines);
    const Defines sides = {"ENVLIGHT_GBUFFER", "ENVLIGHT_LIT"};
    if (has(frame, sides[0]) && has(frame, sides[1])) {
        for (const std::string& side : sides)
            for (const Defines& set : surfaceSets(all)) {
                result.push_back(set);
                result.back().push_back(side);
            }
        return result;
    }
    for (const Defines& set : surfaceSets(all)) result.push_back(set);
    if (frame.empty()) return result;
    for (const Defines& set : product(frame))
        for (const Defines& surface : {Defines{"ENVLIGHT_COOK_TORRANCE"}, Defines{"PHONG_MATERIAL", "HAS_SUN_MAPS"}}) {
            result.push_back(set);
            result.back().insert(result.back().end(), surface.begin(), surface.end());
        }
    return result;
}

std::string withDefines(const std::string& text, const Defines& defines)
{
    const size_t at = text.find('\n') + 1;
    std::string lines;
    for (const std::string& d : defines) lines += "#define " + d + "\n";
    return text.substr(0, at) + lines + text.substr(at);
}

std::string listOf(const Defines& defines)
{
    std::string result = "{";
    for (const std::string& d : defines) result += " " + d;
    return result + " }";
}
