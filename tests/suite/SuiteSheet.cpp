// SPDX-License-Identifier: MIT
// The suite for the eye.
#include "Suite.h"

#include <metrics/Display>
#include <metrics/FalseColor>

#include <ImageFile.h>

#include <algorithm>
#include <cmath>

namespace suite
{

using osgEnvLight::Picture;

namespace
{

const int gap = 4;

// x, y of the lower left corner.
void paste(const Picture& encoded, int x, int y, Picture& sheet)
{
    for (int j = 0; j < encoded.height; ++j) std::copy_n(encoded.at(0, j), 4 * encoded.width, sheet.at(x, y + j));
}

// A line for each scene, and one more for each of its variations.
std::vector<std::vector<const Row*>> lines()
{
    std::vector<std::vector<const Row*>> result;
    for (const Row& row : rows()) {
        const bool same = !result.empty() && std::string(result.back()[0]->scene) == row.scene &&
                          std::string(result.back()[0]->variation.name) == row.variation.name;
        if (!same) result.emplace_back();
        result.back().push_back(&row);
    }
    return result;
}

}  // namespace

void writeContactSheet(const std::string& fileName)
{
    const auto all = lines();
    size_t columns = 0;
    for (const auto& line : all) columns = std::max(columns, line.size());
    const int stepX = 3 * width + 2 * gap;
    const int stepY = height + gap;
    Picture sheet(int(columns) * stepX, int(all.size()) * stepY);
    std::fill(sheet.rgba.begin(), sheet.rgba.end(), 1.0f);
    for (size_t line = 0; line < all.size(); ++line)
        for (size_t column = 0; column < all[line].size(); ++column) {
            if (!hasResult(*all[line][column])) continue;
            const Result& r = result(*all[line][column]);
            if (!r.installed) continue;
            const int x = int(column) * stepX;
            const int y = int(all.size() - 1 - line) * stepY;
            paste(osgEnvLight::displayEncoded(r.picture, r.stops), x, y, sheet);
            paste(osgEnvLight::displayEncoded(r.reference, r.stops), x + width, y, sheet);
            // The darkest colours from a quarter of the display's white.
            paste(osgEnvLight::signedDifference(r.picture, r.reference, 0.25 * std::exp2(-r.stops)), x + 2 * width, y, sheet);
        }
    writeImageFile(*osgEnvLight::eightBit(sheet), fileName);
}

}  // namespace suite
