// SPDX-License-Identifier: MIT
#include "Plot.h"

#include "Text.h"

#include <algorithm>
#include <cmath>

namespace tradeoff
{

namespace
{

const double margin = 0.06;         // of the axis, on both sides
const double leastSpan = 0.2;       // decades
const double leastNumber = 1e-250;  // keeps margins finite
const double greatestNumber = 1e250;

std::vector<double> decadeTicks(double low, double high, const std::vector<double>& digits, int every)
{
    std::vector<double> ticks;
    const int first = int(std::floor(std::log10(low)));
    const int last = int(std::floor(std::log10(high)));
    for (int decade = first; decade <= last; ++decade) {
        if (((decade % every) + every) % every != 0) continue;
        for (double d : digits) {
            const double tick = d * std::pow(10.0, decade);
            if (tick >= low && tick <= high) ticks.push_back(tick);
        }
    }
    return ticks;
}

// Multiples of 1, 2 or 5 times a power of ten.
std::vector<double> evenTicks(double low, double high, size_t most)
{
    for (int decade = int(std::floor(std::log10((high - low) / double(most))));; ++decade)
        for (double d : {1.0, 2.0, 5.0}) {
            const double step = d * std::pow(10.0, decade);
            const double first = std::ceil(low / step);
            const double count = std::floor(high / step) - first + 1.0;
            if (count > double(most)) continue;
            std::vector<double> ticks;
            for (double i = 0.0; i < count; i += 1.0) ticks.push_back((first + i) * step);
            return ticks;
        }
}

std::vector<double> logTicks(double low, double high, size_t most)
{
    std::vector<double> ticks = decadeTicks(low, high, {1.0, 2.0, 5.0}, 1);
    if (ticks.size() < 3) return evenTicks(low, high, most);
    if (ticks.size() > most) ticks = decadeTicks(low, high, {1.0, 3.0}, 1);
    for (int every = 1; ticks.size() > most; ++every) ticks = decadeTicks(low, high, {1.0}, every);
    return ticks;
}

}  // namespace

double Axis::place(double value) const
{
    return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

std::string Axis::tickText(double value) const
{
    // A step of an even axis may have three digits; trailing zeros behind the point say nothing.
    std::string text = roundedNumber(unit == "%" ? 100.0 * value : value, 4);
    const size_t cross = text.find("×");
    std::string mantissa = text.substr(0, cross);
    const std::string power = cross == std::string::npos ? "" : text.substr(cross);
    if (mantissa.find('.') != std::string::npos) {
        mantissa.erase(mantissa.find_last_not_of('0') + 1);
        if (mantissa.back() == '.') mantissa.pop_back();
    }
    const std::string space = unit.empty() ? "" : " ";
    return (mantissa == "1" && !power.empty() ? power.substr(std::string("×").size()) : mantissa + power) + space + unit;
}

Axis logAxis(const std::vector<double>& values, size_t ticks)
{
    Axis axis;
    bool any = false;
    for (double v : values) {
        if (!(v > 0.0) || !std::isfinite(v)) continue;
        v = std::clamp(v, leastNumber, greatestNumber);
        axis.low = any ? std::min(axis.low, v) : v;
        axis.high = any ? std::max(axis.high, v) : v;
        any = true;
    }
    const double low = std::log10(axis.low);
    const double high = std::log10(axis.high);
    const double span = std::max(high - low, leastSpan);
    const double middle = 0.5 * (low + high);
    axis.low = std::pow(10.0, middle - (0.5 + margin) * span);
    axis.high = std::pow(10.0, middle + (0.5 + margin) * span);
    axis.ticks = logTicks(axis.low, axis.high, ticks);
    return axis;
}

}  // namespace tradeoff
