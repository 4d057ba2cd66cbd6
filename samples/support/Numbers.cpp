// SPDX-License-Identifier: MIT
#include "Numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace
{

std::string raised(int exponent)
{
    const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return text;
}

// "4.75e+02"
std::string scientific(double magnitude, int digits)
{
    char text[40];
    const char* end = std::to_chars(text, text + sizeof text, magnitude, std::chars_format::scientific, digits - 1).ptr;
    return std::string(static_cast<const char*>(text), end);
}

}  // namespace

std::string fixedNumber(double value, int decimals)
{
    char text[400];  // 1.8e308 has 309 digits
    return std::string(text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr);
}

std::string roundedNumber(double value, int digits)
{
    if (!std::isfinite(value)) return "–";
    if (value == 0.0) return "0";
    const std::string sign = value < 0.0 ? "−" : "";
    const double magnitude = std::abs(value);
    const std::string text = scientific(magnitude, digits);  // rounding may lead to the next power of ten
    const size_t e = text.find('e');
    const int exponent = std::stoi(text.substr(e + 1));
    if (exponent >= 6 || exponent < -4) return sign + text.substr(0, e) + "×10" + raised(exponent);
    return sign + fixedNumber(magnitude, std::max(0, digits - 1 - exponent));
}

std::string percent(double value)
{
    return roundedNumber(100.0 * value, 2) + "\u00a0%";
}
