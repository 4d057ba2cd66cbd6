// SPDX-License-Identifier: MIT
#pragma once

#include "Summary.h"

namespace tradeoff
{

/** Time against error of all points, in two sizes of which the page shows one, with its legend. */
std::string paretoFigure(const Report& report, const Summary& summary);

/** For each setting that is a number: its error with fits and its time. Empty without one. */
std::string sweepFigures(const Report& report, const Summary& summary);

/** An arrow below a mark: the truth lies there, who knows how far. */
std::string downArrow(double x, double y);

}  // namespace tradeoff
