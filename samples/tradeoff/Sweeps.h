// SPDX-License-Identifier: MIT
// Which settings are measured.
#pragma once

#include "Report.h"

#include <osgEnvLight/Settings>

namespace tradeoff
{

/** A point before it is measured. */
struct Candidate {
    std::string sweep;
    std::string value;
    double number = unknown;
    Texts settings;  // to set on top of the scene's own
};

/** Name and values of "occlusionLights=64,256,1024". Throws std::invalid_argument with a message for the user. */
std::pair<std::string, std::vector<std::string>> parseSweep(const std::string& text);

/** What is to be measured beside the defaults. */
struct Selection {
    std::vector<std::pair<std::string, std::vector<std::string>>>
        sweeps;                     // as parseSweep gives them; in place of the default ones
    std::vector<std::string> only;  // names of sweeps and presets; empty: all
    bool specular = true;           // whether the term S runs: else its knobs are left out
    bool areaLights = false;        // whether there are any with shadows: else their knobs are left out
    bool full = false;              // whether the reference has all light: else the bounce is left out
    bool quick = false;             // every other value of the sweeps that matter most
};

/** The defaults, the other presets, the default sweeps, then those asked for; with `only`, the defaults and what it names, in its
 * order. Throws std::invalid_argument with a message for the user where a name or a value does not exist. */
std::vector<Candidate> candidates(const Selection& selection);

/** In which order to measure them, as indices: the presets, then the sweeps in turn, each its ends before what is between, so
 * that what is cut short leaves something of every sweep. Those of one sweep stand together. */
std::vector<size_t> measuringOrder(const std::vector<Candidate>& all);

/** base with the candidate's settings; changed receives those that differ from base. */
void apply(const Candidate& candidate, const osgEnvLight::Settings& base, osgEnvLight::Settings& settings, Texts& changed);

}  // namespace tradeoff
