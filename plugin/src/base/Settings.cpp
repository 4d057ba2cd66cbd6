// SPDX-License-Identifier: MIT
#include <osgEnvLight/Settings>

#include <charconv>
#include <cmath>

namespace osgEnvLight
{

namespace
{

// The shortest text that reads back as the same number.
template <class T>
std::string numberText(T value)
{
    char text[32];
    const auto [end, status] = std::to_chars(text, text + sizeof(text), value);
    return std::string(text, end);
}

bool isInteger(const Settings::Property& p)
{
    return !std::holds_alternative<float Settings::*>(p.member);
}

bool inRange(const Settings::Property& p, double value)
{
    return value >= p.minimum && value <= p.maximum && (!isInteger(p) || value == std::floor(value));
}

std::string rangeError(const Settings::Property& p, const std::string& found)
{
    return std::string("setting '") + p.name + "' is " + found + ", expected " + p.range();
}

// The value that text stands for, or NaN.
double parse(const Settings::Property& p, const std::string& text)
{
    if (std::holds_alternative<bool Settings::*>(p.member)) return text == "on" ? 1.0 : text == "off" ? 0.0 : std::nan("");
    for (size_t i = 0; i < p.choices.size(); ++i)
        if (text == p.choices[i]) return double(i);
    double value = 0.0;
    auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool number = p.choices.empty() && status == std::errc() && end == text.data() + text.size();
    return number ? value : std::nan("");
}

Settings::Property onOff(const char* name, bool Settings::*member, const char* description)
{
    return {name, member, 0, 1, "", description, {}};
}

Settings::Property number(const char* name, int Settings::*member, int low, int high, const char* unit, const char* description)
{
    return {name, member, double(low), double(high), unit, description, {}};
}

Settings::Property real(const char* name, float Settings::*member, double low, double high, const char* unit,
                        const char* description)
{
    return {name, member, low, high, unit, description, {}};
}

Settings::Property choice(const char* name, int Settings::*member, std::vector<const char*> choices, const char* description)
{
    return {name, member, 0, double(choices.size() - 1), "", description, choices};
}

}  // namespace

Settings::Settings(const Settings& other, const osg::CopyOp& copyop) : osg::Object(other, copyop)
{
    for (const Property& p : table()) p.put(*this, p.get(other));
}

const std::vector<const char*>& Settings::lightSamplerNames()
{
    static const std::vector<const char*> names = {"auto", "split", "median-cut", "structured", "penrose", "inverse-cdf"};
    return names;
}

const std::vector<Settings::Property>& Settings::table()
{
    using S = Settings;
    static const std::vector<Property> properties = {
        onOff("diffuse", &S::diffuse, "the term D: diffuse reflection of the map"),
        onOff("specular", &S::specular, "the term S: glossy reflection of the map"),
        onOff("occlusion", &S::occlusion, "the term O: what the scene itself keeps from D, with the shadows of the suns"),
        choice("materialColors", &S::materialColors, {"srgb", "linear"},
               "colours of osg::Material, of vertices and of unlit surfaces: display values, shown under the map's exposure as "
               "typed, or scene-linear; colours of our own Material are always linear"),
        choice("lightSampler", &S::lightSampler, lightSamplerNames(), "how the map is made into lights (LightSampler)"),
        choice("lightWeights", &S::lightWeights, {"auto", "off", "on"},
               "reweighting of the lights by the map's spherical harmonics; auto: after split and auto"),
        real("lightFloor", &S::lightFloor, 0, 100, "means of the map",
             "radiance added to the map where lights are placed, so that dark parts have some; their flux stays true"),
        choice("lightDeal", &S::lightDeal, {"moments", "random"},
               "how lights are dealt to the 16 groups of O: each a good sample of the map, or shuffled"),
        choice("suns", &S::suns, {"off", "glossy", "auto"},
               "cut suns and lamps out of the map, shade them as discs and give each a shadow map: for S only, or for D as well"),
        choice("regeneration", &S::regeneration, {"background", "immediate"},
               "a changed map becomes light on a thread of its own, visible when ready, and shadow maps are drawn some a frame; "
               "or all within the frame that sees the change"),
        choice(
            "diffuseCarrier", &S::diffuseCarrier, {"auto", "sh", "lights"},
            "what D sums: 18 spherical harmonics of the map, diffuseLights of its lights, or the cheapest within diffuseError"),
        real("diffuseError", &S::diffuseError, 0, 100, "percent",
             "RMS error of D that diffuseCarrier = auto allows; where nothing keeps it, the most exact is taken"),
        number("diffuseLights", &S::diffuseLights, 1, 65536, "lights",
               "importance-sampled lights of the map for D; with diffuseCarrier = auto, at most"),
        number("specularSamples", &S::specularSamples, 1, 1024, "samples per pixel", "directions sampled from the BRDF for S"),
        choice(
            "visibility", &S::visibility, {"auto", "screen", "atlas", "both", "none"},
            "what O asks whether a light is seen: the depth buffer, which knows what the view shows; the sky shadow atlas, a "
            "small shadow map for each light; both, the depth buffer within nearRadius; auto: both where anything casts shadows"),
        number("atlasLights", &S::atlasLights, 16, 1024, "lights",
               "lights of the map that have a shadow map, a sixteenth of them in each pixel; rounded up to a multiple of 16"),
        number("atlasSize", &S::atlasSize, 16, 512, "texels", "side of each shadow map of the atlas"),
        number("atlasUpdatesPerFrame", &S::atlasUpdatesPerFrame, 1, 1024, "maps per frame",
               "shadow maps drawn again each frame while the scene or the map changes; with regeneration = immediate, all"),
        number("sunShadowSize", &S::sunShadowSize, 64, 4096, "texels",
               "side of each sun's shadow maps; where there are more than four they share the memory of four"),
        real("nearRadius", &S::nearRadius, 0, 100, "texels of the atlas",
             "how far O looks on the screen where the atlas knows the rest; 0: not at all"),
        number("nearTaps", &S::nearTaps, 1, 32, "taps a side", "occlusionTaps of that"),
        number(
            "occlusionLights", &S::occlusionLights, 16, 65536, "lights",
            "lights whose visibility O tests on the screen, a sixteenth of them in each pixel; rounded up to a multiple of 16"),
        choice(
            "occlusionMethod", &S::occlusionMethod, {"slice", "ray", "point", "gtao", "bent-normal"},
            "how O searches the depth buffer: slices through the pixel, whose bits all its lights share, or a ray for each "
            "light; for comparison one point a ray, which seed 000 printed, the share of the sky above the slices' horizons, or "
            "the open share of it about its mean direction; beside the atlas always slices"),
        number("occlusionSlices", &S::occlusionSlices, 1, 4, "slices a pixel", "planes through the view ray that are searched"),
        number("occlusionTaps", &S::occlusionTaps, 1, 32, "taps a side",
               "points of the depth buffer that each of a slice's two sides looks at"),
        number("occlusionSteps", &S::occlusionSteps, 1, 256, "points per ray",
               "points at which a ray is compared with the depth buffer, with occlusionMethod = ray"),
        real("occlusionRadius", &S::occlusionRadius, 0, 100, "radii of the scene",
             "how far O looks on the screen without an atlas: length of the rays, reach of the slices; 0 switches that off"),
        real("occlusionThickness", &S::occlusionThickness, 0, 1000, "radii of the occlusion",
             "how deep a surface seen in the depth buffer is taken to be"),
        number("filterCells", &S::filterCells, 1, 8, "cells of 4 pixels",
               "width of the filter that averages the groups of lights"),
        choice("combine", &S::combine, {"ratio", "subtract"},
               "D - O as D times the filtered visibility, or as the printed subtraction of two light lists"),
        choice("sceneLights", &S::sceneLights, {"auto", "on", "off"},
               "the lights of osg::LightSource nodes, without shadows; auto: but not the viewer's own head or sky light"),
        choice(
            "bounce", &S::bounce, {"off", "mean"},
            "what is reflected from surface to surface: nothing, or the mean of what the picture shows where light is blocked, "
            "by the share of directions that a pixel does not see of the map"),
        onOff("accumulate", &S::accumulate,
              "while camera, scene and map stand still, average frames with fresh lights, shadow maps and sub-pixel offsets "
              "until the picture is that of exact direct light"),
        number("accumulateFrames", &S::accumulateFrames, 1, 65536, "frames", "frames that a still view averages before it rests"),
        number(
            "accumulateLights", &S::accumulateLights, 16, 1024, "lights per frame",
            "fresh lights of the map, each with a shadow map of its own, in each frame of a still view; rounded up to a multiple "
            "of 16"),
        number("accumulateSize", &S::accumulateSize, 16, 4096, "texels",
               "side of the shadow maps of a still view, half of it in the first 15 frames"),
        choice("background", &S::background, {"off", "on", "blur", "auto"},
               "the map behind the scene; auto: unless a sky or backdrop of the application's, below the node or drawn before it "
               "in a "
               "negative bin, is there"),
        real("backgroundBlur", &S::backgroundBlur, 0, 90, "degrees", "width of the blur of background = blur"),
        choice("view", &S::view,
               {"beauty", "diffuse", "specular", "occlusion", "visibility", "albedo", "normal", "depth", "emission", "bounce",
                "lights"},
               "the picture, or one of its intermediates"),
        choice("output", &S::output, {"display", "linear"},
               "what the host receives: exposed, tone mapped and encoded for a display, or scene-linear radiance"),
        choice("exposureBase", &S::exposureBase, {"map", "none"},
               "what exposure adds to: stops that show a white surface at .63 in the middle between the map's mean and greatest "
               "irradiance, or 0"),
        real("exposure", &S::exposure, -32, 32, "stops",
             "added to exposureBase; radiance is multiplied by 2 to this power before the tone curve"),
        choice("toneCurve", &S::toneCurve, {"clip", "reinhard", "neutral", "shoulder"},
               "from radiance to the display's range: none, Reinhard 2002, Khronos PBR Neutral, or that with only its highlights "
               "bent"),
        onOff("dither", &S::dither, "ordered dither of half an 8-bit step against bands"),
    };
    return properties;
}

const Settings::Property* Settings::find(const std::string& name)
{
    for (const Property& p : table())
        if (name == p.name) return &p;
    return nullptr;
}

double Settings::Property::get(const Settings& settings) const
{
    return std::visit([&](auto m) { return double(settings.*m); }, member);
}

void Settings::Property::put(Settings& settings, double value) const
{
    std::visit([&](auto m) { settings.*m = static_cast<std::decay_t<decltype(settings.*m)>>(value); }, member);
}

std::string Settings::Property::getString(const Settings& settings) const
{
    double value = get(settings);
    if (std::holds_alternative<bool Settings::*>(member)) return value != 0.0 ? "on" : "off";
    if (!choices.empty() && inRange(*this, value)) return choices[size_t(value)];
    return std::holds_alternative<float Settings::*>(member) ? numberText(float(value)) : numberText(value);
}

std::string Settings::Property::range() const
{
    if (std::holds_alternative<bool Settings::*>(member)) return "on | off";
    std::string text;
    for (const char* c : choices) text += (text.empty() ? "" : " | ") + std::string(c);
    if (!text.empty()) return text;
    return (isInteger(*this) ? "a whole number in " : "a number in ") + numberText(minimum) + ".." + numberText(maximum) +
           (*unit ? std::string(" ") + unit : std::string());
}

bool Settings::set(const std::string& name, const std::string& value, std::string& error)
{
    if (name == "preset") return setPreset(value, error);
    const Property* p = find(name);
    if (p) {
        double x = parse(*p, value);
        if (inRange(*p, x)) {
            p->put(*this, x);
            return true;
        }
        error = rangeError(*p, "'" + value + "'");
        return false;
    }
    error = "no setting is named '" + name + "'; there are";
    for (const Property& known : table()) error += std::string(" ") + known.name;
    return false;
}

bool Settings::set(const std::string& name, double value, std::string& error)
{
    const Property* p = find(name);
    if (!p) return set(name, std::string(), error);
    if (!inRange(*p, value)) {
        error = rangeError(*p, numberText(value));
        return false;
    }
    p->put(*this, value);
    return true;
}

bool Settings::valid(std::string& error) const
{
    for (const Property& p : table())
        if (!inRange(p, p.get(*this))) {
            error = rangeError(p, numberText(p.get(*this)));
            return false;
        }
    return true;
}

}  // namespace osgEnvLight
