// SPDX-License-Identifier: MIT
// Prints surface/LtcTableValues.cpp.
#include "LtcFit.h"

#include "surface/LtcTable.h"

#include <cmath>
#include <cstdio>

using osgEnvLight::ltcSide;
using osgEnvLight::ltcUnit;

int main()
{
    std::puts(
        R"(// SPDX-License-Identifier: MIT
// Made by envlight_ltc_table (plugin/tables).
#include "surface/LtcTable.h"

namespace osgEnvLight
{

// clang-format off
const LtcTable ltcTable = {{)");
    for (int y = 0; y < ltcSide; ++y) {
        int x = 0;
        for (const auto& entry : fitLtcRow(double(y) / (ltcSide - 1), ltcSide))
            for (size_t k = 0; k < 4; ++k, ++x)
                std::printf("%s%ld%s", x % 16 ? " " : "    ", std::lround(entry[k] / ltcUnit), x % 16 == 15 ? ",\n" : ",");
    }
    std::puts("}};\n// clang-format on\n\n}  // namespace osgEnvLight");
}
