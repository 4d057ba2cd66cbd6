// SPDX-License-Identifier: MIT
// Which of the measured settings are worth having. Time is the median of the frame, error that of the beauty picture.
#pragma once

#include "Report.h"

#include <optional>

namespace tradeoff
{

using Choice = std::optional<size_t>;

/** The points that no other beats in time and error, the fastest first; of equal ones the first. */
std::vector<size_t> paretoFront(const std::vector<Point>& points);

/** Another is no slower and no less exact, and better in one of both. Points without a measurement are not. */
bool isDominated(const std::vector<Point>& points, size_t index);

/** The point of the front that lies farthest below the straight line between the front's ends, both axes logarithmic:
 * before it an error is lessened for less time than is usual on this front, behind it for more. Factors on either axis and
 * dominated points don't matter. An error of 0, which has no logarithm, counts as a tenth of the smallest other one.
 *
 * Where none lies below (fronts of two points, or that bend the other way), it is the end whose product of time and error is
 * smaller, the faster if they are equal. None for an empty front.*/
Choice kneeOf(const std::vector<Point>& points);

/** The fastest whose error is no larger; of equally fast ones the most exact. */
Choice cheapestWithin(const std::vector<Point>& points, double error);

/** The most exact that takes no longer; of equally exact ones the fastest. */
Choice mostExactWithin(const std::vector<Point>& points, double milliseconds);

/** The point that answers a target. */
Choice answerTo(const Target& target, const std::vector<Point>& points);

/** The first measured one with the default settings. */
Choice defaultOf(const std::vector<Point>& points);

}  // namespace tradeoff
