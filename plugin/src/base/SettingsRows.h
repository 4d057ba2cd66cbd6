/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Settings>

#include <vector>

namespace osgEnvLight
{

/** What a struct of settings makes its properties() of. */
namespace rows
{

inline SettingsProperty onOff(const char* name, bool Settings::*member, const char* description)
{
    return {name, member, 0, 1, "", description, {}};
}

inline SettingsProperty number(const char* name, int Settings::*member, int low, int high, const char* unit,
                               const char* description)
{
    return {name, member, double(low), double(high), unit, description, {}};
}

inline SettingsProperty real(const char* name, float Settings::*member, double low, double high, const char* unit,
                             const char* description)
{
    return {name, member, low, high, unit, description, {}};
}

inline SettingsProperty choice(const char* name, int Settings::*member, const std::vector<const char*>& choices,
                               const char* description)
{
    return {name, member, 0, double(choices.size() - 1), "", description, choices};
}

/** That shaders read. */
inline SettingsProperty uniform(SettingsProperty property)
{
    property.uniform = true;
    return property;
}

/** That changes only how the picture is shown. */
inline SettingsProperty shown(SettingsProperty property)
{
    property.shown = true;
    return property;
}

}  // namespace rows

}  // namespace osgEnvLight
