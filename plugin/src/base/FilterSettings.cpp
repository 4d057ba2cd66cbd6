// SPDX-License-Identifier: MIT
#include "base/SettingsRows.h"

namespace osgEnvLight
{

std::vector<SettingsProperty> FilterSettings::properties()
{
    using S = FilterSettings;
    using namespace rows;
    return {
        uniform(number("filterCells", &S::filterCells, 1, 8, "cells of 4 pixels",
                       "width of the filter that averages the groups of lights")),
        choice("combine", &S::combine, {"ratio", "subtract"},
               "D - O as D times the filtered visibility, or as the printed subtraction of two light lists"),
    };
}

}  // namespace osgEnvLight
