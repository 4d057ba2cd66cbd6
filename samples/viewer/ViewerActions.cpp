// SPDX-License-Identifier: MIT
// What the keys do.
#include "EnvlightViewer.h"

#include "ImageFile.h"
#include "PictureName.h"
#include "TextureImage.h"

#include <metrics/Display>
#include <osgEnvLight/ModelCameras>

#include <cmath>
#include <iostream>
#include <utility>

using osgEnvLight::Settings;

void EnvlightViewer::perform(Action action, double value)
{
    switch (action) {
        case Action::SHOW_KEYS:
            _keysShown = !_keysShown;
            break;
        case Action::SHOW_PANEL:
            _panelShown = !_panelShown;
            break;
        case Action::GO_HOME:
            endRadiance(false);
            _view.goHome();
            break;
        case Action::NEXT_CAMERA:
            endRadiance(false);
            goToNextCamera();
            break;
        case Action::FULL_SCREEN:
            _window.toggleFullScreen();
            break;
        case Action::QUIT:
            _window.close();
            break;
        case Action::SAVE_PICTURE:
        case Action::SAVE_RADIANCE:
        case Action::COPY_COMMAND:
            _pending.push_back(action);
            break;
        default:
            endRadiance(false);
            _history.record();  // several keys may come with one frame
            changeSetting(action, value);
            _view.requestRedraw();
    }
}

void EnvlightViewer::changeSetting(Action action, double value)
{
    Settings& s = settings();
    std::string error;
    const auto next = [&](const char* name) {
        const Settings::Property& p = *Settings::find(name);
        p.put(s, std::fmod(p.get(s) + 1.0, double(p.choices.size())));
        say(std::string(name) + ": " + p.getString(s));
    };
    switch (action) {
        case Action::VIEW:
            Settings::find("view")->put(s, value);
            say("view: " + Settings::find("view")->getString(s));
            break;
        case Action::NEXT_VIEW:
            next("view");
            break;
        case Action::PRESET: {
            const Settings::Preset& preset = Settings::presets()[size_t(value)];
            s.setPreset(preset.name, error);
            say(std::string("preset ") + preset.name + ": " + preset.purpose);
            break;
        }
        case Action::CONVERGE:
            s.accumulate = !s.accumulate;
            say(s.accumulate ? "a still view converges" : "a still view rests");
            break;
        case Action::BACKGROUND:
            next("background");
            break;
        case Action::GROUND:
            next("ground");
            break;
        case Action::EXPOSURE:
            if (s.set("exposure", double(s.exposure) + value, error))
                say("exposure: " + Settings::find("exposure")->getString(s));
            break;
        case Action::TURN_MAP:
            turnMap(value);
            break;
        case Action::UNDO:
            if (!_history.undo()) say("nothing to undo");
            break;
        case Action::REDO:
            if (!_history.redo()) say("nothing to redo");
            break;
        case Action::RELOAD_SHADERS:
            _lit->reloadShaders();
            say("shader files are read again");
            break;
        default:
            break;
    }
}

void EnvlightViewer::performPending()
{
    for (const Action action : std::exchange(_pending, {})) {
        if (action == Action::SAVE_PICTURE) savePicture();
        if (action == Action::SAVE_RADIANCE && !_radiance) beginRadiance();
        if (action == Action::COPY_COMMAND) copyCommand();
    }
}

void EnvlightViewer::goToNextCamera()
{
    const std::vector<osgEnvLight::ModelCamera> cameras = osgEnvLight::findModelCameras(*_lit);
    if (cameras.empty()) {
        say("the model has no cameras");
        return;
    }
    const osgEnvLight::ModelCamera& camera = cameras[_nextCamera++ % cameras.size()];
    _view.look(camera.view);
    say("camera: " + camera.name);
}

void EnvlightViewer::turnMap(double degrees)
{
    osgEnvLight::EnvironmentMap& map = *_lit->getEnvironmentMap();
    map.setRotation(std::remainder(map.getRotation() + degrees, 360.0));
    _view.requestRedraw();
}

void EnvlightViewer::savePicture()
{
    const std::string name = unusedName(_origin.file, "png");
    try {
        writeImageFile(*osgEnvLight::eightBit(pictureOf(*_view.keptImage())), name);
        say(name);
    } catch (const std::exception& e) {
        say(e.what(), true);
    }
}

void EnvlightViewer::beginRadiance()
{
    const unsigned frames = settings().accumulate ? _lit->average().frames : 0;
    _radiance = RadiancePicture{unusedName(_origin.file, "exr"), frames};
    settings().output = Settings::LINEAR;
    _view.requestRedraw();
}

void EnvlightViewer::endRadiance(bool save)
{
    if (!_radiance) return;
    const std::string name = _radiance->name;
    _radiance.reset();
    settings().output = Settings::DISPLAY;
    _view.requestRedraw();
    if (!save) {
        say(name + " is not written: something else was asked for before it had converged", true);
        return;
    }
    try {
        writeImageFile(*_view.drawnImage(), name);
        say(name);
    } catch (const std::exception& e) {
        say(e.what(), true);
    }
}

// Copied, and printed for those who started this in a terminal.
void EnvlightViewer::copyCommand()
{
    if (_origin.file.empty()) {
        say("there is no scene to render");
        return;
    }
    const std::string command = renderCommand(*_lit, _origin, _view.camera(), _view.width(), _view.height());
    _window.setClipboard(command);
    std::cout << command << std::endl;
    say("copied: " + command);
}
