// SPDX-License-Identifier: MIT
// envlight_image_suite: fifteen scenes under four maps and more, ours beside
// the reference, as a picture and as a table:
//   envlight_image_suite [FOLDER]     writes FOLDER/image-suite.png and
//   FOLDER/image-suite.csv
#include "Suite.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
    const std::string folder = argc > 1 ? argv[1] : ".";
    try {
        double error = 0.0, withoutOcclusion = 0.0;
        int count = 0;
        for (const suite::Row& row : suite::rows()) {
            const suite::Result& r = suite::result(row);
            if (!r.installed) continue;
            ++count;
            error += r.figures[suite::TONED];
            withoutOcclusion += r.withoutOcclusion;
        }
        suite::writeContactSheet(folder + "/image-suite.png");
        suite::writeTable(folder + "/image-suite.csv");
        std::cout << count << " of " << suite::rows().size() << " pictures; tone-mapped RMSE " << error / count
                  << ", without occlusion " << withoutOcclusion / count << "\n";
    } catch (const std::exception& error) {
        std::cerr << "envlight_image_suite: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
