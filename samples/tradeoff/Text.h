// SPDX-License-Identifier: MIT
// Numbers and names as text, whatever the locale is.
#pragma once

#include "Numbers.h"

namespace tradeoff
{

/** Unrounded, as C, CSV and JSON read it; "" if it is not finite. */
std::string exactNumber(double value);

/** "47.5 ms" */
std::string milliseconds(double value);

/** With two decimals, for the coordinates of SVG. */
std::string coordinate(double value);

/** Text as it stands in HTML and in the value of an attribute. */
std::string escaped(const std::string& text);

/** How many letters of UTF-8. */
size_t letters(const std::string& text);

}  // namespace tradeoff
