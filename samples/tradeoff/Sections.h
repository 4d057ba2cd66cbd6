// SPDX-License-Identifier: MIT
// The files and the parts of the page.
#pragma once

#include "Summary.h"

namespace tradeoff
{

/** Embedded from page.css and page.js. */
extern const char* const pageStyle;
extern const char* const pageScript;

/** The whole index.html. */
std::string htmlPage(const Report& report);

/** The whole tradeoff.csv: a row for each point. */
std::string csvText(const Report& report);

/** All points, their figures, and the passes' times in columns that a switch shows. */
std::string pointsTable(const Report& report, const Summary& summary);

/** Ours over the reference, with a slider between them. */
std::string comparison(const Report& report);

/** Of each term: the pictures and where its error is. */
std::string termSections(const Report& report);

}  // namespace tradeoff
