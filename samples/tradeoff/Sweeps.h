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

/** The presets, then the default sweeps that can matter in this scene, then those asked for; asked is what parseSweep gave, and
 * replaces the default sweep of its name. Throws std::invalid_argument where a name or value is no setting's.
 * @param specular  whether the plan has the term S
 * @param quick     every other value */
std::vector<Candidate> candidates(const std::vector<std::pair<std::string, std::vector<std::string>>>& asked, bool specular,
                                  bool quick);

/** base with the candidate's settings; changed receives those that differ from base. */
void apply(const Candidate& candidate, const osgEnvLight::Settings& base, osgEnvLight::Settings& settings, Texts& changed);

}  // namespace tradeoff
