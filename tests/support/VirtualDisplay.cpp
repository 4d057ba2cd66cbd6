// SPDX-License-Identifier: MIT
#include "VirtualDisplay.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace
{

void restBriefly()
{
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
}

// The server's file is an X window dump: a header of big-endian words.
unsigned word(const std::string& dump, size_t i)
{
    unsigned value = 0;
    for (size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(dump[4 * i + k]);
    return value;
}

bool uniform(const Screen& s)
{
    for (size_t i = 3; i < s.rgb.size(); ++i)
        if (s.rgb[i] != s.rgb[i - 3]) return false;
    return true;
}

}  // namespace

VirtualDisplay::VirtualDisplay(int width, int height)
{
    // -noreset: the server would forget everything when the first program ends.
    _server = std::make_unique<BackgroundProgram>(
        std::vector<std::string>{"Xvfb", "-displayfd", "1", "-noreset", "-nolisten", "tcp", "-fbdir", _folder.file("."),
                                 "-screen", "0", std::to_string(width) + "x" + std::to_string(height) + "x24"},
        _folder.file("log"));
    for (int i = 0; i < 100 && _server->running(); ++i, restBriefly()) {
        const std::string log = readFile(_folder.file("log"));
        size_t digit = log.find_first_of("0123456789");
        if (digit == std::string::npos || log.find('\n', digit) == std::string::npos) continue;
        _name = ":" + log.substr(digit, log.find_first_not_of("0123456789", digit) - digit);
        return;
    }
}

Screen VirtualDisplay::read(int width, int height) const
{
    const std::string dump = readFile(_folder.file("Xvfb_screen0"));
    if (dump.size() < 100) return {};
    const size_t start = word(dump, 0) + 12 * word(dump, 19);
    const size_t stride = word(dump, 12);
    if (int(word(dump, 4)) < width || int(word(dump, 5)) < height || dump.size() < start + stride * size_t(height)) return {};
    Screen s{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (size_t k : {2u, 1u, 0u})  // stored as BGRX
                s.rgb.push_back(static_cast<unsigned char>(dump[start + stride * size_t(y) + 4 * size_t(x) + k]));
    return s;
}

Screen VirtualDisplay::waitForPicture(int width, int height, int seconds) const
{
    Screen former;
    int still = 0;
    for (int i = 0; i < 5 * seconds; ++i, restBriefly()) {
        Screen now = read(width, height);
        const bool same = !now.rgb.empty() && now.rgb == former.rgb && !uniform(now);
        still = same ? still + 1 : 0;
        if (still >= 4) return now;
        former = std::move(now);
    }
    return {};
}
