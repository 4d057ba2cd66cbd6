// SPDX-License-Identifier: MIT
#include "KeyTable.h"

#include <osgEnvLight/Settings>

#include <osgGA/GUIEventAdapter>

#include <algorithm>

namespace
{

using osgEnvLight::Settings;
using Symbol = osgGA::GUIEventAdapter;

KeyBinding row(int key, const std::string& label, const std::string& purpose, Action action, double value = 0.0)
{
    const bool repeats =
        action == Action::EXPOSURE || action == Action::TURN_MAP || action == Action::NEXT_VIEW || action == Action::NEXT_CAMERA;
    return {key, false, repeats, label, purpose, action, value};
}

KeyBinding withControl(char key, const std::string& label, const std::string& purpose, Action action)
{
    return {key, true, true, label, purpose, action, 0.0};
}

// 1 is the first one, 0 the tenth.
void addViews(std::vector<KeyBinding>& rows)
{
    const std::vector<const char*>& names = Settings::find("view")->choices;
    for (int i = 0; i < int(std::min<size_t>(names.size(), 10)); ++i) {
        const char key = char('0' + (i + 1) % 10);
        rows.push_back(row(key, std::string(1, key), "view: " + std::string(names[size_t(i)]), Action::VIEW, i));
    }
    rows.push_back(row('V', "V", "next view", Action::NEXT_VIEW));
}

void addPresets(std::vector<KeyBinding>& rows)
{
    const std::vector<Settings::Preset>& presets = Settings::presets();
    for (int i = 0; i < int(presets.size()); ++i) {
        const int function = 5 + i;
        rows.push_back(row(Symbol::KEY_F1 + function - 1, "F" + std::to_string(function),
                           "preset: " + std::string(presets[size_t(i)].name), Action::PRESET, i));
    }
}

std::vector<KeyBinding> makeTable()
{
    std::vector<KeyBinding> rows = {
        row('h', "h", "this list", Action::SHOW_KEYS),
        row(Symbol::KEY_Tab, "Tab", "panel of settings and times", Action::SHOW_PANEL),
        row(' ', "Space", "home position", Action::GO_HOME),
        row('n', "n", "next camera of the model", Action::NEXT_CAMERA),
        row('f', "f", "full screen", Action::FULL_SCREEN),
        row(Symbol::KEY_Escape, "Esc", "quit", Action::QUIT),
        row('a', "a", "let a still view converge", Action::CONVERGE),
        row('b', "b", "next background", Action::BACKGROUND),
        row('g', "g", "ground that shows the shadows", Action::GROUND),
        row('+', "+", "brighter by half a stop", Action::EXPOSURE, 0.5),
        row('-', "-", "darker by half a stop", Action::EXPOSURE, -0.5),
        row('[', "[", "turn the map clockwise", Action::TURN_MAP, -15.0),
        row(']', "]", "turn the map counter-clockwise", Action::TURN_MAP, 15.0),
        withControl('z', "Ctrl Z", "undo a setting", Action::UNDO),
        withControl('y', "Ctrl Y", "redo it", Action::REDO),
        row(Symbol::KEY_F2, "F2", "save the picture as PNG", Action::SAVE_PICTURE),
        row(Symbol::KEY_F3, "F3", "save its radiance as EXR", Action::SAVE_RADIANCE),
        row('c', "c", "copy the command that renders it", Action::COPY_COMMAND),
        row('R', "R", "read shader files again", Action::RELOAD_SHADERS),
    };
    addPresets(rows);
    addViews(rows);
    return rows;
}

}  // namespace

const std::vector<KeyBinding>& keyTable()
{
    static const std::vector<KeyBinding> table = makeTable();
    return table;
}

const KeyBinding* findBinding(const InputEvent& event)
{
    if (event.type != InputEvent::KEY) return nullptr;
    for (const KeyBinding& b : keyTable())
        if (b.key == event.key && b.control == event.control) return b.repeats || !event.repeated ? &b : nullptr;
    return nullptr;
}
