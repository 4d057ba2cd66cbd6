// SPDX-License-Identifier: MIT
#include "Gui.h"

#include <osgDB/FileUtils>

#include <imgui.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>

namespace
{

const float textSize = 16.0f;

// The font that Debian's desktops have, else the one that is built in, which is made for its own size.
void chooseFont(ImGuiIO& io, float scale)
{
    const std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    if (osgDB::fileExists(font)) {
        static const ImWchar latinGreekCyrillic[] = {0x20, 0x24F, 0x370, 0x52F, 0x2010, 0x2027, 0};
        io.Fonts->AddFontFromFileTTF(font.c_str(), std::round(textSize * scale), nullptr, latinGreekCyrillic);
        return;
    }
    ImFontConfig config;
    config.SizePixels = 13.0f * std::max(1.0f, std::round(scale));
    io.Fonts->AddFontDefault(&config);
}

}  // namespace

Gui::Gui(GlfwWindow& window)
{
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4.0f;
    style.Colors[ImGuiCol_WindowBg].w = 0.85f;
    // Glyphs are drawn for the pixels, sizes are in units of the window.
    io.FontGlobalScale = 1.0f / window.pixelsPerUnit();
    style.ScaleAllSizes(window.contentScale() * io.FontGlobalScale);
    chooseFont(io, window.contentScale());
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Gui::~Gui()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::beginFrame()
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Gui::endFrame()
{
    ImGui::Render();
}

void Gui::draw()
{
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wantsPointer() const
{
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsKeys() const
{
    return ImGui::GetIO().WantCaptureKeyboard;
}

bool Gui::isInUse() const
{
    return ImGui::IsAnyItemActive();
}
