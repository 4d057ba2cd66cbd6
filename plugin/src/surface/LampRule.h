/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

namespace osgEnvLight
{

/** Which surfaces that glow are area lights by themselves. */
struct LampRule {
    bool finds = false;         // false: none
    float least = 0.0f;         // emission as typed, linear, above which a surface of Material::LIGHT_AUTO is one
    bool displayColors = true;  // the host's colours are display values, sRGB encoded
};

}  // namespace osgEnvLight
