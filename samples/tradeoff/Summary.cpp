// SPDX-License-Identifier: MIT
#include "Summary.h"

#include "Text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace tradeoff
{

const std::vector<FigureColumn> figureColumns = {
    {"tRMSE", &Figures::tRMSE}, {"relMSE", &Figures::relMSE}, {"rmse", &Figures::rmse}, {"bias", &Figures::bias},
    {"p99", &Figures::p99},     {"ssim", &Figures::ssim},     {"flip", &Figures::flip}, {"noise", &Figures::noise}};

namespace
{

void addOnce(std::vector<std::string>& list, const std::string& name)
{
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

std::string cost(const Point& p)
{
    return milliseconds(p.frame.median) + " a frame, " + errorText(p.beauty) + " error (tone-mapped RMSE)";
}

// What half the time and half the error of the defaults are to be had for.
std::string prospects(const Report& report, const Point& usual)
{
    std::string text;
    if (const Choice fast = mostExactWithin(report.points, 0.5 * usual.frame.median)) {
        const Figures& error = report.points[*fast].beauty;
        text += error.error() > usual.beauty.error()
                    ? "; in half the time the error is " + errorText(error)
                    : "; half the time is to be had without more error, by " + nameOf(report.points[*fast]);
    } else {
        text += "; nothing measured is twice as fast";
    }
    if (!usual.beauty.resolved || !(usual.beauty.error() > 0.0)) return text;
    if (const Choice exact = cheapestWithin(report.points, 0.5 * usual.beauty.error()))
        text += "; half the error costs " + milliseconds(report.points[*exact].frame.median);
    else
        text += "; nothing measured halves the error";
    return text;
}

nlohmann::ordered_json valueOf(const std::string& text)
{
    double number = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return text;
    if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<long long>(number);
    return number;
}

}  // namespace

Summary::Summary(const Report& report)
    : front(paretoFront(report.points)), usual(defaultOf(report.points)), knee(kneeOf(report.points))
{
    for (const Point& p : report.points) {
        addOnce(sweeps, p.sweep);
        for (const auto& pass : p.passes) addOnce(passes, pass.first);
        for (const auto& term : p.terms) addOnce(terms, term.first);
        for (const auto& setting : p.settings) addOnce(varied, setting.first);
    }
}

size_t Summary::sweepOf(const Point& point) const
{
    return size_t(std::find(sweeps.begin(), sweeps.end(), point.sweep) - sweeps.begin());
}

std::vector<Answer> answersOf(const Report& report, const Summary& summary)
{
    std::vector<Answer> answers = {{"Default settings", summary.usual, "Not measured."},
                                   {"Knee of the front", summary.knee, "Nothing could be measured."}};
    for (const Target& t : report.targets) {
        const bool error = t.kind == Target::ERROR;
        answers.push_back({error ? "Cheapest within " + percent(t.value) : "Most exact within " + milliseconds(t.value),
                           answerTo(t, report.points),
                           error ? "No measured settings are as exact as that." : "No measured settings are as fast as that."});
    }
    return answers;
}

std::string headline(const Report& report, const Summary& summary)
{
    if (summary.front.empty()) return "Nothing could be measured.";
    if (!summary.usual) {
        const Point& knee = report.points[*summary.knee];
        return "The default settings were not measured. The knee of the others, " + nameOf(knee) + ": " + cost(knee) + ".";
    }
    const Point& usual = report.points[*summary.usual];
    return "Default settings: " + cost(usual) + prospects(report, usual) + ".";
}

std::string nameOf(const Point& point)
{
    return point.sweep == "preset" ? point.value : point.sweep + " " + point.value;
}

std::string settingsOf(const Point& point)
{
    std::string text;
    for (const auto& [name, value] : point.settings) text += (text.empty() ? "" : ", ") + name + " = " + value;
    return text.empty() ? "defaults" : text;
}

std::string settingsJson(const Point& point)
{
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    for (const auto& [name, value] : point.settings) settings[name] = valueOf(value);
    return "\"settings\": " + settings.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string errorText(const Figures& figures)
{
    return (figures.resolved ? "" : "< ") + percent(figures.error());
}

const Spread* passOf(const Point& point, const std::string& name)
{
    const auto pass =
        std::find_if(point.passes.begin(), point.passes.end(), [&](const auto& candidate) { return candidate.first == name; });
    return pass == point.passes.end() ? nullptr : &pass->second;
}

const Figures* termOf(const Point& point, const std::string& name)
{
    const auto term = point.terms.find(name);
    return term == point.terms.end() ? nullptr : &term->second;
}

}  // namespace tradeoff
