// SPDX-License-Identifier: MIT
#include "SettingsPanel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace osgEnvLight;
using Property = Settings::Property;

struct Group {
    const char* title;
    SettingsGroup properties;
};

const Group groups[] = {
    {"Display", OutputSettings::properties},
    {"Background", BackgroundSettings::properties},
    {"Still view", StillViewSettings::properties},
    {"Terms", TermSettings::properties},
    {"Materials", SurfaceSettings::properties},
    {"Lights of the map", LightListSettings::properties},
    {"Diffuse", DiffuseSettings::properties},
    {"Specular", SpecularSettings::properties},
    {"Sky shadows", SkyShadowSettings::properties},
    {"Sun shadows", SunShadowSettings::properties},
    {"Occlusion on the screen", OcclusionSettings::properties},
    {"Filter", FilterSettings::properties},
    {"Lights of the scene", SceneLightSettings::properties},
    {"Area lights", AreaLightSettings::properties},
    {"Indirect light", BounceSettings::properties},
};

const Settings& usualSettings()
{
    static const osg::ref_ptr<const Settings> usual = new Settings;
    return *usual;
}

bool editSwitch(const Property& p, Settings& settings)
{
    bool on = p.get(settings) != 0.0;
    if (!ImGui::Checkbox(p.name, &on)) return false;
    p.put(settings, on ? 1.0 : 0.0);
    return true;
}

bool editChoice(const Property& p, Settings& settings)
{
    int chosen = int(p.get(settings));
    if (!ImGui::Combo(p.name, &chosen, p.choices.data(), int(p.choices.size()))) return false;
    p.put(settings, chosen);
    return true;
}

bool editInteger(const Property& p, Settings& settings)
{
    int value = int(p.get(settings));
    const bool wide = p.maximum >= 64.0 * p.minimum;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    if (!ImGui::SliderInt(p.name, &value, int(p.minimum), int(p.maximum), "%d", flags)) return false;
    p.put(settings, value);
    return true;
}

bool dragValue(const char* name, float& value, float minimum, float maximum)
{
    const float speed = std::max(0.01f * std::abs(value), 0.005f);
    return ImGui::DragFloat(name, &value, speed, minimum, maximum, "%.3g", ImGuiSliderFlags_AlwaysClamp);
}

bool editReal(const Property& p, Settings& settings)
{
    float value = float(p.get(settings));
    if (!dragValue(p.name, value, float(p.minimum), float(p.maximum))) return false;
    p.put(settings, double(value));
    return true;
}

bool editValue(const Property& p, Settings& settings)
{
    if (!p.choices.empty()) return editChoice(p, settings);
    if (std::holds_alternative<bool Settings::*>(p.member)) return editSwitch(p, settings);
    if (std::holds_alternative<int Settings::*>(p.member)) return editInteger(p, settings);
    return editReal(p, settings);
}

void describe(const Property& p)
{
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0f * ImGui::GetFontSize());
    ImGui::TextWrapped("%s", p.description);
    ImGui::TextWrapped("%s %s; right click: default, %s", p.range().c_str(), p.unit, p.getString(usualSettings()).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool edit(const Property& p, Settings& settings)
{
    const bool differs = p.get(settings) != p.get(usualSettings());
    if (differs) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.8f, 0.4f, 1.0f));
    bool changed = editValue(p, settings);
    if (differs) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) describe(p);
    if (differs && ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
        p.put(settings, p.get(usualSettings()));
        changed = true;
    }
    return changed;
}

bool showPresets(Settings& settings)
{
    bool changed = false;
    std::string error;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("preset");
    for (const Settings::Preset& preset : Settings::presets()) {
        ImGui::SameLine();
        if (ImGui::Button(preset.name)) changed = settings.setPreset(preset.name, error);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", preset.purpose);
    }
    return changed;
}

bool showMap(EnvironmentMap& map)
{
    float degrees = float(map.getRotation()), intensity = float(map.getIntensity());
    const bool turned =
        ImGui::SliderFloat("map rotation", &degrees, -180.0f, 180.0f, "%.0f degrees", ImGuiSliderFlags_AlwaysClamp);
    if (turned) map.setRotation(double(degrees));
    const bool dimmed = dragValue("map intensity", intensity, 0.0f, 1e6f);
    if (dimmed) map.setIntensity(double(intensity));
    return turned || dimmed;
}

// What the window shows is always for a display.
bool isOffered(const Property& p)
{
    return std::string(p.name) != "output";
}

}  // namespace

bool showSettings(LitScene& lit)
{
    Settings& settings = *lit.getSettings();
    bool changed = showPresets(settings);
    ImGui::PushItemWidth(0.5f * ImGui::GetContentRegionAvail().x);
    changed |= showMap(*lit.getEnvironmentMap());
    for (const Group& group : groups) {
        if (!ImGui::CollapsingHeader(group.title)) continue;
        for (const Property& p : group.properties())
            if (isOffered(p)) changed |= edit(p, settings);
    }
    ImGui::PopItemWidth();
    return changed;
}
