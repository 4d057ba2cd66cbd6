// SPDX-License-Identifier: MIT
#include "Overlay.h"

#include "KeyTable.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace
{

const ImGuiWindowFlags passive = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;

const std::pair<const char*, const char*> mouse[] = {
    {"left drag", "orbit"},
    {"middle drag", "move"},
    {"right drag, wheel", "nearer and further"},
    {"Shift left drag", "turn the map"},
    {"drop a file", "a model, a scene or a map"},
};

// At this place of the window, 0 to 1, and that point of the part there.
void begin(const char* name, float x, float y)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float margin = 0.5f * ImGui::GetFontSize();
    const ImVec2 place(margin + x * (size.x - 2 * margin), margin + y * (size.y - 2 * margin));
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, ImVec2(x, y));
    ImGui::Begin(name, nullptr, passive);
}

// Smaller text where the window has no room for so many lines in a table, each as wide as so many heights of the text.
void fitIntoWindow(float width, float lines)
{
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float textHeight = ImGui::GetFontSize();
    const float spacing = 2.0f * ImGui::GetStyle().CellPadding.y * lines;
    const float scale = std::min(room.x / width, (room.y - spacing) / (lines + 3.0f)) / textHeight;
    ImGui::SetWindowFontScale(std::clamp(scale, 0.4f, 1.0f));
}

void showCell(const char* left, const char* right)
{
    ImGui::TableNextColumn();
    ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.4f, 1.0f), "%s", left);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(right);
}

}  // namespace

void showKeys()
{
    begin("keys", 0.0f, 0.0f);
    const std::vector<KeyBinding>& keys = keyTable();
    const size_t rows = (keys.size() + 1) / 2;
    fitIntoWindow(32.0f, float(rows + std::size(mouse)));
    if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (size_t i = 0; i < rows; ++i)
            for (size_t k = i; k < keys.size(); k += rows) showCell(keys[k].label.c_str(), keys[k].purpose.c_str());
        ImGui::EndTable();
    }
    ImGui::Separator();
    if (ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& [gesture, purpose] : mouse) showCell(gesture, purpose);
        ImGui::EndTable();
    }
    ImGui::End();
}

void showDropHint()
{
    begin("hint", 0.5f, 0.5f);
    ImGui::TextUnformatted("Drop a model, a scene (.envlight) or an environment map here; h lists the keys.");
    ImGui::End();
}

void showMessage(const std::string& text, bool isError)
{
    const float width = ImGui::GetIO().DisplaySize.x - 2.0f * ImGui::GetFontSize();
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(width, 1e6f));
    begin("message", 0.0f, 1.0f);
    if (isError) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.5f, 0.4f, 1.0f));
    ImGui::PushTextWrapPos(width - ImGui::GetFontSize());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (isError) ImGui::PopStyleColor();
    ImGui::End();
}
