// SPDX-License-Identifier: MIT
// envlight_image_suite: fifteen scenes under four maps and more, ours beside the reference, as a picture and as a table:
//   envlight_image_suite [--table FILE] [--set NAME=VALUE]... [--rows TEXT] [FOLDER]
//     FOLDER        gets image-suite.png and image-suite.csv
//     --table FILE  writes the table there instead: tests/suite/measured.csv is what the tests' bounds follow from
//     --set         a setting of all rows
//     --rows TEXT   only those whose names contain it
#include "Suite.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
    std::string folder = ".", table, rows;
    try {
        for (int i = 1; i < argc; ++i) {
            const std::string argument = argv[i];
            const std::string value = i + 1 < argc ? argv[i + 1] : "";
            const size_t equals = value.find('=');
            if (argument == "--table")
                table = value;
            else if (argument == "--rows")
                rows = value;
            else if (argument == "--set")
                suite::setForAllRows(value.substr(0, equals), equals == std::string::npos ? "" : value.substr(equals + 1));
            else
                folder = argument;
            if (argument.rfind("--", 0) == 0) ++i;
        }
        double error = 0.0, withoutOcclusion = 0.0, bounced = 0.0, withoutBounce = 0.0;
        int count = 0;
        for (const suite::Row& row : suite::rows()) {
            if (row.name().find(rows) == std::string::npos) continue;
            const suite::Result& r = suite::result(row);
            if (!r.installed) continue;
            ++count;
            error += r.figures[suite::TONED];
            withoutOcclusion += r.withoutOcclusion;
            bounced += r.figures[suite::BOUNCED];
            withoutBounce += r.withoutBounce;
            if (r.seconds > 5.0) std::cout << row.name() << " took " << r.seconds << " s\n";
        }
        suite::writeContactSheet(folder + "/image-suite.png");
        suite::writeMeasured(table.empty() ? folder + "/image-suite.csv" : table);
        std::cout << count << " of " << suite::rows().size() << " pictures; tone-mapped RMSE " << error / count
                  << ", without occlusion " << withoutOcclusion / count << "; beside full light transport " << bounced / count
                  << ", without the bounce " << withoutBounce / count << "\n";
    } catch (const std::exception& error) {
        std::cerr << "envlight_image_suite: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
