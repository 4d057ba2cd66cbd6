// SPDX-License-Identifier: MIT
#pragma once

#include "Gui.h"
#include "KeyTable.h"
#include "RenderCommand.h"
#include "SceneView.h"
#include "SettingsHistory.h"

#include <chrono>

/** The program: a scene in a window, what the user does to it, and what lies over it. It draws only when something has changed.
 */
class EnvlightViewer
{
  public:
    /** Throws BadArguments, or std::runtime_error if there is no window or the scene can't be read. */
    explicit EnvlightViewer(const SceneOptions& options);

    /** Until the window is closed. */
    void run();

  private:
    using Clock = std::chrono::steady_clock;
    enum class Drag { NONE, CAMERA, MAP };

    struct Message {
        std::string text;
        bool isError = false;
        Clock::time_point end;
    };

    // A picture of radiance that is to converge as far as what is shown.
    struct RadiancePicture {
        std::string name;
        unsigned frames;
    };

    void turn();
    void handle(const InputEvent& event);
    void handlePointer(const InputEvent& event);
    void showGui();
    void showPanel();
    bool drawScene();
    void present();

    void perform(Action action, double value);
    void changeSetting(Action action, double value);
    void performPending();
    void goToNextCamera();
    void turnMap(double degrees);
    void savePicture();
    void beginRadiance();
    void endRadiance(bool save);
    void copyCommand();
    void open(const std::string& file);
    void openDropped();

    void say(const std::string& text, bool isError = false);
    void setTitle();
    osgEnvLight::Settings& settings() { return *_lit->getSettings(); }

    SceneOrigin _origin;
    osg::ref_ptr<osgEnvLight::LitScene> _lit;
    GlfwWindow _window;
    Gui _gui;
    SceneView _view;
    SettingsHistory _history;

    size_t _nextCamera = 0;
    Drag _drag = Drag::NONE;
    double _dragX = 0.0;
    bool _keysShown = false;
    bool _panelShown = false;
    bool _busy = true;
    int _guiFrames = 0;  // to draw, until it has settled
    double _milliseconds = 0.0;
    Message _message;
    std::optional<RadiancePicture> _radiance;
    std::vector<std::string> _dropped;
    std::vector<Action> _pending;  // what takes the next frame, in which all that was asked for before is done
};
