// SPDX-License-Identifier: MIT
#include "Text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tradeoff
{

std::string exactNumber(double value)
{
    if (!std::isfinite(value)) return "";
    char text[40];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string milliseconds(double value)
{
    return roundedNumber(value) + "\u00a0ms";
}

std::string coordinate(double value)
{
    return fixedNumber(value, 2);
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else if (c == '\'')
            result += "&#39;";
        else if (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t')
            result += "�";
        else
            result += c;
    }
    return result;
}

size_t letters(const std::string& text)
{
    return size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace tradeoff
