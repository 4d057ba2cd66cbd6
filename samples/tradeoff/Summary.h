// SPDX-License-Identifier: MIT
// What follows from the measurements and more than one part of the page speaks of.
#pragma once

#include "Pareto.h"

namespace tradeoff
{

struct Summary {
    explicit Summary(const Report& report);

    std::vector<std::string> sweeps;  // these lists are in the order of appearance
    std::vector<std::string> passes;
    std::vector<std::string> terms;
    std::vector<std::string> varied;  // the settings that differ from the defaults anywhere
    std::vector<size_t> front;
    Choice usual;  // the defaults
    Choice knee;

    size_t sweepOf(const Point& point) const;
};

/** A part of the page that stands out: a question and the point that answers it. */
struct Answer {
    std::string question;
    Choice point;
    std::string none;  // what is said if there is no point
};

/** Defaults, knee, and what was asked for. */
std::vector<Answer> answersOf(const Report& report, const Summary& summary);

/** The essential sentence of the report. */
std::string headline(const Report& report, const Summary& summary);

/** "draft", "occlusionLights 256" */
std::string nameOf(const Point& point);

/** "occlusionLights = 256, filterCells = 1"; "defaults" */
std::string settingsOf(const Point& point);

/** The member of scene.envlight that makes these settings. */
std::string settingsJson(const Point& point);

/** "2.1 %"; "< 0.2 %" where the reference can't tell. */
std::string errorText(const Figures& figures);

/** The numbers of Figures by the names that files give them. */
struct FigureColumn {
    const char* name;
    double Figures::*value;
};
extern const std::vector<FigureColumn> figureColumns;

/** The measurement of that name, or none. */
const Spread* passOf(const Point& point, const std::string& name);
const Figures* termOf(const Point& point, const std::string& name);

}  // namespace tradeoff
