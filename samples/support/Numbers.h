// SPDX-License-Identifier: MIT
// Numbers as people read them, whatever the locale is.
#pragma once

#include <string>

/** With so many decimals. */
std::string fixedNumber(double value, int decimals);

/** "475", "0.047", "1.2×10⁶"; an en dash if it is not finite. */
std::string roundedNumber(double value, int digits = 3);

/** The same of 100 times the value, with two digits: "2.1 %". */
std::string percent(double value);
