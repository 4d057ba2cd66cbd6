// SPDX-License-Identifier: MIT
#include "PassTimes.h"

#include <imgui.h>

namespace
{

using osgEnvLight::LitScene;
using osgEnvLight::PassReport;

void showAverage(const LitScene& lit)
{
    const osgEnvLight::Average average = lit.average();
    const int most = lit.getSettings()->accumulateFrames;
    if (average.frames == 0) {
        ImGui::TextUnformatted("converging when the view stands still");
        return;
    }
    ImGui::Text("%u of %d frames, %u lights", average.frames, most, average.lights);
    if (average.standardError >= 0.0) ImGui::Text("standard error %.2f %%", 100.0 * average.standardError);
    ImGui::ProgressBar(float(average.frames) / float(most), ImVec2(-1, 0));
}

void showPass(const PassReport& pass)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(pass.pass.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", pass.reason.c_str());
    for (const double time : {pass.gpu, pass.cpu}) {
        ImGui::TableNextColumn();
        if (time >= 0.0) ImGui::Text("%.2f", time);
    }
}

void showRunning(const std::vector<PassReport>& passes)
{
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("pass", 0, 3.0f);
    ImGui::TableSetupColumn("GPU ms", 0, 1.5f);
    ImGui::TableSetupColumn("CPU ms", 0, 1.5f);
    ImGui::TableHeadersRow();
    for (const PassReport& pass : passes)
        if (pass.runs) showPass(pass);
    ImGui::EndTable();
}

}  // namespace

void showProgress(const LitScene& lit, double frame)
{
    ImGui::Text("frame %.1f ms, textures %.0f MB", frame, 1e-6 * double(lit.textureBytes()));
    if (lit.getSettings()->accumulate) showAverage(lit);
}

void showPasses(const LitScene& lit)
{
    const std::vector<PassReport> passes = lit.plan().passes;
    if (ImGui::CollapsingHeader("Passes", ImGuiTreeNodeFlags_DefaultOpen)) showRunning(passes);
    if (!ImGui::CollapsingHeader("Passes that are off")) return;
    for (const PassReport& pass : passes)
        if (!pass.runs) ImGui::TextWrapped("%s: %s", pass.pass.c_str(), pass.reason.c_str());
}
