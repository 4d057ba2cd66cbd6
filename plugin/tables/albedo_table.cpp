// SPDX-License-Identifier: MIT
// Prints surface/AlbedoTableValues.cpp.
#include "AlbedoIntegral.h"

#include "base/Limits.h"
#include "surface/AlbedoTable.h"

#include <cmath>
#include <cstdio>
#include <iterator>

#include "glsl.h"

namespace
{

using namespace osgEnvLight;

const unsigned points = 16384;
const int microfacets[] = {BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG};
static_assert(std::size(microfacets) == limits::ALBEDO_BLOCKS);

std::array<double, 3> albedoAt(int block, double roughness, double cosV)
{
    if (block < limits::ALBEDO_BLOCKS) return lobeAlbedo(microfacets[block], roughness, cosV, points);
    return brushedAlbedo(roughness, double(block - limits::ALBEDO_BLOCKS) / (limits::ANISOTROPY_BLOCKS - 1), cosV, points);
}

}  // namespace

int main()
{
    std::puts(R"(// SPDX-License-Identifier: MIT
// Made by envlight_albedo_table (plugin/tables).
#include "surface/AlbedoTable.h"

namespace osgEnvLight
{

// clang-format off
const AlbedoTable albedoTable = {{)");
    for (int block = 0; block < albedoBlocks; ++block)
        for (int y = 0; y < albedoSide; ++y)
            for (int x = 0; x < albedoSide; ++x) {
                const double rootMu = double(y) / (albedoSide - 1);
                for (const double value : albedoAt(block, double(x) / (albedoSide - 1), rootMu * rootMu))
                    std::printf("%ld,", std::lround(value / albedoUnit));
                if (x == albedoSide - 1) std::puts("");
            }
    std::puts("}};\n// clang-format on\n\n}  // namespace osgEnvLight");
}
