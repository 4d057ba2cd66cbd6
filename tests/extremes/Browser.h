// SPDX-License-Identifier: MIT
// What headless Chromium makes of pages, each at several widths.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

struct Findings {
    std::map<std::pair<std::string, int>, nlohmann::json> pages;  // by name and width: what the probe returned
    std::vector<std::string> console;                             // lines, of whatever level
};

/** The command, or "" if Chromium is not installed. */
std::string browserCommand();

/** Opens folders/NAME/index.html of each name, in one run; the probe is the body of a function that runs in the page after it has
 * loaded and returns an object. Exceptions that the page throws are in its member "exceptions".*/
Findings probePages(const std::string& folder, const std::vector<std::string>& names, const std::vector<int>& widths,
                    const std::string& probe);
