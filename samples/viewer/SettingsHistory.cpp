// SPDX-License-Identifier: MIT
#include "SettingsHistory.h"

#include <algorithm>
#include <utility>

using osgEnvLight::Settings;

SettingsHistory::SettingsHistory(osgEnvLight::LitScene& lit) : _lit(lit)
{
    restart();
}

void SettingsHistory::restart()
{
    _states.assign(1, now());
    _present = 0;
}

SettingsHistory::State SettingsHistory::now() const
{
    osgEnvLight::EnvironmentMap* map = _lit.getEnvironmentMap();
    return {new Settings(*_lit.getSettings()), map, map->getRotation(), map->getIntensity()};
}

bool SettingsHistory::same(const State& a, const State& b)
{
    const auto equal = [&](const Settings::Property& p) { return p.get(*a.settings) == p.get(*b.settings); };
    return a.map == b.map && a.rotation == b.rotation && a.intensity == b.intensity &&
           std::all_of(Settings::table().begin(), Settings::table().end(), equal);
}

void SettingsHistory::restore(const State& state)
{
    for (const Settings::Property& p : Settings::table()) p.put(*_lit.getSettings(), p.get(*state.settings));
    state.map->setRotation(state.rotation);
    state.map->setIntensity(state.intensity);
    _lit.setEnvironmentMap(state.map.get());
}

void SettingsHistory::record()
{
    State state = now();
    if (same(state, _states[_present])) return;
    _states.resize(++_present);
    _states.push_back(std::move(state));
}

bool SettingsHistory::undo()
{
    if (!canUndo()) return false;
    restore(_states[--_present]);
    return true;
}

bool SettingsHistory::redo()
{
    if (!canRedo()) return false;
    restore(_states[++_present]);
    return true;
}
