// SPDX-License-Identifier: MIT
// How an error falls with the number of samples.
#pragma once

#include <cstddef>
#include <vector>

namespace tradeoff
{

/** error = a N^-p + b: the part that more samples lessen, and the floor, which is bias. */
struct Fit {
    double a = 0.0;
    double p = 0.0;
    double b = 0.0;
    double deviation = 0.0;    // RMS of ln error - ln fit
    std::vector<size_t> used;  // indices of the pairs that it is made of

    /** Fewer than two counts are no fit. */
    bool valid() const { return !used.empty(); }
    double at(double n) const;
};

/** The least squares of ln error, with b >= 0 and, where there is a floor, 0 < p <= 4. Pairs whose count or error is not a
 * positive number are left out. Two counts tell no floor, b = 0; neither does an error that grows with N, where p < 0.
 * Where all errors are equal, all is floor: a = p = 0.*/
Fit fitPowerLaw(const std::vector<double>& counts, const std::vector<double>& errors);

}  // namespace tradeoff
