// SPDX-License-Identifier: MIT
#pragma once

#include <VirtualDisplay.h>

#include <functional>

/** envlight-viewer on a display of its own, in a folder of its own, driven by events of the X server. */
class ViewerWindow
{
  public:
    static constexpr int width = 320;
    static constexpr int height = 240;

    /** With these arguments, and --size. */
    explicit ViewerWindow(const std::vector<std::string>& arguments);

    /** False if there is no Xvfb or no xdotool. */
    static bool isPossible();
    /** Until its window is there and has a picture. */
    bool opens();
    bool running() { return _program->running(); }

    /** As xdotool types and moves: {"key", "ctrl+z"}. */
    void act(const std::vector<std::string>& words);
    void key(const std::string& name) { act({"key", name}); }
    /** The pointer pulls from here to there; holding: a modifier, or "". */
    void drag(const std::string& holding, int fromX, int fromY, int toX, int toY);
    bool drop(const std::string& file);

    /** The command that it prints for what it shows, by its key c; "" if it prints none. */
    std::string command();
    std::string title();
    /** A file of its folder; waits until it is a complete picture. */
    std::string file(const std::string& name) const { return _folder.file(name); }
    bool waitForFile(const std::string& name);
    /** Waits for what is true soon. */
    static bool waitUntil(const std::function<bool()>& condition, int seconds = 60);
    /** What is shown now, and once it has stopped changing. */
    Screen screen() const { return _display.read(width, height); }
    Screen stillScreen() const { return _display.waitForPicture(width, height, 120); }
    std::string log() const { return readFile(_log.file("log")); }
    const std::string& display() const { return _display.name(); }

  private:
    std::string xdotool(const std::vector<std::string>& words);

    VirtualDisplay _display;
    TemporaryFolder _folder;
    TemporaryFolder _log;
    std::unique_ptr<BackgroundProgram> _program;
    std::string _window;  // its number
};
