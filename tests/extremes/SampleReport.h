// SPDX-License-Identifier: MIT
// A report as the measuring might give it, from a model of times and errors.
#pragma once

#include "Report.h"

/** Presets and seven sweeps: 46 points, pictures of a sphere on a plane, both kinds of target. */
tradeoff::Report sampleReport();

/** One point of that model. */
tradeoff::Point samplePoint(const std::string& sweep, const std::string& value, const tradeoff::Texts& settings);
