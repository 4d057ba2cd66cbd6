// SPDX-License-Identifier: MIT
#include "EnvlightViewer.h"

#include "FileLoader.h"
#include "Overlay.h"
#include "PassTimes.h"
#include "SettingsPanel.h"

#include <osgDB/FileNameUtils>

#include <imgui.h>

#include <algorithm>
#include <utility>

namespace
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

const double idleWait = 0.25;  // seconds
const int settlingFrames = 3;  // of a part of the GUI that appears or changes its size

// Of the command line; origin is what it was without --set.
osg::ref_ptr<LitScene> loadScene(SceneOptions options, SceneOrigin& origin)
{
    const std::vector<std::string> chosen = std::exchange(options.settings, {});
    osg::ref_ptr<LitScene> lit = options.load(false);
    origin = {options.scene, options.map.empty() ? lit->getEnvironmentMap()->getMap() : "", new Settings(*lit->getSettings())};
    options.settings = chosen;
    options.applySettings(*lit->getSettings());
    lit->getSettings()->output = Settings::DISPLAY;
    return lit;
}

const char* titleOfProgram = "envlight-viewer";

}  // namespace

EnvlightViewer::EnvlightViewer(const SceneOptions& options)
    : _lit(loadScene(options, _origin)),
      _window(options.width, options.height, titleOfProgram),
      _gui(_window),
      _view(*_lit, options, std::max(_window.width(), 1), std::max(_window.height(), 1)),
      _history(*_lit)
{
    setTitle();
    if (_lit->getNumChildren() > 0) say("h lists the keys, Tab shows the settings");
}

void EnvlightViewer::run()
{
    while (!_window.isClosing()) turn();
}

void EnvlightViewer::turn()
{
    const std::vector<InputEvent> events = _window.takeEvents(_busy ? 0.0 : idleWait);
    if (!events.empty()) _guiFrames = settlingFrames;
    _gui.beginFrame();
    for (const InputEvent& event : events) handle(event);
    _busy = false;
    if (_window.isShown()) _view.resize(_window.width(), _window.height());
    showGui();
    _gui.endFrame();
    if (!_gui.isInUse() && _drag == Drag::NONE && !_radiance) _history.record();
    if (!_window.isShown()) return;
    const bool drawn = drawScene();
    if (drawn || _guiFrames > 0) present();
    _guiFrames = std::max(_guiFrames - 1, 0);
    performPending();
    openDropped();
    _busy = drawn || _guiFrames > 0;
}

void EnvlightViewer::handle(const InputEvent& event)
{
    switch (event.type) {
        case InputEvent::KEY:
            if (_gui.wantsKeys()) break;
            if (const KeyBinding* binding = findBinding(event))
                perform(binding->action, binding->value);
            else if (!event.control && !event.repeated)
                _view.handle(event);
            break;
        case InputEvent::DROP:
            _dropped = event.files;
            say("reading " + osgDB::getSimpleFileName(event.files.front()));
            break;
        case InputEvent::REDRAW:
            break;
        default:
            handlePointer(event);
    }
}

void EnvlightViewer::handlePointer(const InputEvent& event)
{
    if (_drag == Drag::NONE && (_gui.wantsPointer() || event.type == InputEvent::MOVE || event.type == InputEvent::RELEASE))
        return;
    if (event.type == InputEvent::PRESS && _drag == Drag::NONE) {
        _drag = event.shift && event.button == 1 ? Drag::MAP : Drag::CAMERA;
        _dragX = event.x;
    }
    endRadiance(false);
    if (_drag != Drag::MAP)
        _view.handle(event);
    else if (event.type == InputEvent::MOVE)
        turnMap(-180.0 * (event.x - std::exchange(_dragX, event.x)) / _window.width());
    if (event.type == InputEvent::RELEASE) _drag = Drag::NONE;
}

void EnvlightViewer::showGui()
{
    const bool spoken = !_message.text.empty();
    if (spoken && Clock::now() > _message.end) {
        _message.text.clear();
        _guiFrames = settlingFrames;
    }
    _lit->setTimed(_panelShown);
    if (_panelShown) showPanel();
    if (_lit->getNumChildren() == 0 && !_keysShown) showDropHint();
    if (!_message.text.empty()) showMessage(_message.text, _message.isError);
    if (_keysShown) showKeys();
}

// At the right edge, as high as the window.
void EnvlightViewer::showPanel()
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = std::min(24.0f * ImGui::GetFontSize(), 0.45f * size.x);
    ImGui::SetNextWindowPos(ImVec2(size.x - width, 0));
    ImGui::SetNextWindowSize(ImVec2(width, size.y));
    ImGui::Begin("settings", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    showProgress(*_lit, _milliseconds);
    if (showSettings(*_lit)) {
        endRadiance(false);
        _view.requestRedraw();
    }
    showPasses(*_lit);
    ImGui::End();
}

// Whether there was anything new.
bool EnvlightViewer::drawScene()
{
    if (!_view.needsFrame()) return false;
    _milliseconds = _view.draw();
    if (!_radiance) {
        _view.keep();
        return true;
    }
    const unsigned frames = _lit->average().frames;
    if (frames >= _radiance->frames || !_view.needsFrame())
        endRadiance(true);
    else
        say(_radiance->name + ": frame " + std::to_string(frames) + " of " + std::to_string(_radiance->frames));
    return true;
}

void EnvlightViewer::present()
{
    _view.show();
    _gui.draw();
    _window.swap();
}

void EnvlightViewer::openDropped()
{
    for (const std::string& file : std::exchange(_dropped, {})) open(file);
}

void EnvlightViewer::open(const std::string& file)
{
    const LoadedFile loaded = loadFile(file, *_lit);
    endRadiance(false);
    if (loaded.kind == Loaded::NOTHING) {
        say(loaded.error, true);
        return;
    }
    say(osgDB::getSimpleFileName(file));
    if (loaded.kind == Loaded::MODEL) _origin = {file, "sky", new Settings};
    if (loaded.kind == Loaded::SCENE) {
        _origin = {file, _lit->getEnvironmentMap()->getMap(), new Settings(settings())};
        _history.restart();
    }
    if (loaded.kind != Loaded::MAP) {
        setTitle();
        _nextCamera = 0;
        _view.goTo(loaded.homeView);
    }
    _view.requestRedraw();
}

void EnvlightViewer::say(const std::string& text, bool isError)
{
    _message = {text, isError, Clock::now() + std::chrono::seconds(isError ? 15 : 5)};
    _guiFrames = settlingFrames;
}

void EnvlightViewer::setTitle()
{
    const std::string scene = osgDB::getSimpleFileName(_origin.file);
    _window.setTitle(scene.empty() ? titleOfProgram : scene + " - " + titleOfProgram);
}
