// SPDX-License-Identifier: MIT
#include "ViewerWindow.h"

#include "FileDrop.h"

#include <osgDB/ReadFile>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace
{

std::vector<std::string> startedIn(const std::string& folder, const std::vector<std::string>& arguments)
{
    std::vector<std::string> command = {"bash", "-c",   "cd \"$1\" && shift && exec \"$@\"",
                                        "bash", folder, std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-viewer"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"--size", std::to_string(ViewerWindow::width) + "x" + std::to_string(ViewerWindow::height)});
    return command;
}

}  // namespace

bool ViewerWindow::isPossible()
{
    return std::system("command -v Xvfb >/dev/null && command -v xdotool >/dev/null") == 0;
}

ViewerWindow::ViewerWindow(const std::vector<std::string>& arguments) : _display(width, height)
{
    _program = std::make_unique<BackgroundProgram>(startedIn(_folder.file("."), arguments), _log.file("log"),
                                                   std::vector<std::string>{"DISPLAY=" + _display.name()});
}

bool ViewerWindow::opens()
{
    const bool found = waitUntil([&] {
        return !(_window = xdotool({"search", "--name", "envlight-viewer"})).empty() || !running();
    });
    if (!found || _window.empty()) return false;
    act({"mousemove", "160", "120"});
    return !stillScreen().rgb.empty();
}

std::string ViewerWindow::xdotool(const std::vector<std::string>& words)
{
    std::vector<std::string> command = {"xdotool"};
    command.insert(command.end(), words.begin(), words.end());
    const std::string out = runProgram(command, {"DISPLAY=" + _display.name()}).out;
    return out.substr(0, out.find('\n'));
}

void ViewerWindow::act(const std::vector<std::string>& words)
{
    xdotool(words);
}

void ViewerWindow::drag(const std::string& holding, int fromX, int fromY, int toX, int toY)
{
    act({"mousemove", std::to_string(fromX), std::to_string(fromY)});
    if (!holding.empty()) act({"keydown", holding});
    act({"mousedown", "1"});
    const int steps = 4;
    for (int i = 1; i <= steps; ++i)
        act({"mousemove", std::to_string(fromX + (toX - fromX) * i / steps), std::to_string(fromY + (toY - fromY) * i / steps)});
    act({"mouseup", "1"});
    if (!holding.empty()) act({"keyup", holding});
}

bool ViewerWindow::drop(const std::string& file)
{
    return dropFile(_display.name(), std::stoul(_window), file);
}

std::string ViewerWindow::command()
{
    const std::string before = log();
    key("c");
    std::string line;
    waitUntil(
        [&] {
            const std::string added = log().substr(before.size());
            const size_t start = added.find("envlight-render ");
            const size_t end = added.find('\n', start);
            if (start == std::string::npos || end == std::string::npos) return false;
            line = added.substr(start, end - start);
            return true;
        },
        20);
    return line;
}

std::string ViewerWindow::title()
{
    return xdotool({"getwindowname", _window});
}

bool ViewerWindow::waitForFile(const std::string& name)
{
    return waitUntil([&] { return std::filesystem::exists(file(name)) && osgDB::readRefImageFile(file(name)); });
}

bool ViewerWindow::waitUntil(const std::function<bool()>& condition, int seconds)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    do {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    } while (std::chrono::steady_clock::now() < end);
    return false;
}
