// SPDX-License-Identifier: MIT
// Prints lights/PenroseTable.cpp.
#include "PenroseRelaxation.h"

#include <cstdio>

int main()
{
    const osgEnvLight::PenroseTable table = relaxedPenroseTable();
    std::puts(
        "// SPDX-License-Identifier: MIT\n"
        "// Made by envlight_penrose_table (plugin/tables).\n"
        "#include \"lights/PenroseTable.h\"\n\n"
        "namespace osgEnvLight\n{\n\n"
        "// clang-format off\n"
        "const PenroseTable penroseTable = {{");
    for (const auto& row : table.shift) {
        std::printf("    {");
        for (size_t s = 0; s < 21; ++s)
            std::printf("%s{%.3ff, %.3ff}", s == 0 ? "" : s % 7 ? ", " : ",\n     ", double(row[s][0]), double(row[s][1]));
        std::puts("},");
    }
    std::puts("}};\n// clang-format on\n\n}  // namespace osgEnvLight");
}
