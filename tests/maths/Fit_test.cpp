// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Fit.h"

namespace Fit_test
{

using tradeoff::Fit;
using tradeoff::fitPowerLaw;

namespace
{

const std::vector<double> powersOfTwo = {16, 32, 64, 128, 256, 512, 1024, 2048};

std::vector<double> law(const std::vector<double>& counts, double a, double p, double b)
{
    std::vector<double> errors;
    for (double n : counts) errors.push_back(a * std::pow(n, -p) + b);
    return errors;
}

std::vector<double> firstOf(const std::vector<double>& all, size_t count)
{
    return std::vector<double>(all.begin(), all.begin() + std::ptrdiff_t(count));
}

// Sum of squares of the logarithms, written out a second time.
double squares(const std::vector<double>& counts, const std::vector<double>& errors, double a, double p, double b)
{
    double sum = 0.0;
    for (size_t i = 0; i < counts.size(); ++i) sum += std::pow(std::log(errors[i] / (a * std::pow(counts[i], -p) + b)), 2.0);
    return sum;
}

}  // namespace

TEST(Fit, FindsTheLaw)
{
    for (double p : {0.3, 0.5, 1.0, 1.7, 3.0})
        for (double share : {0.0, 0.02, 0.3, 0.9})  // of the floor at the first count
            for (size_t count : {size_t(3), size_t(4), size_t(8)}) {
                SCOPED_TRACE(std::to_string(p) + " " + std::to_string(share) + " " + std::to_string(count));
                const std::vector<double> counts = firstOf(powersOfTwo, count);
                const double a = 0.2 * (1.0 - share) * std::pow(16.0, p);
                const double b = 0.2 * share;
                const Fit fit = fitPowerLaw(counts, law(counts, a, p, b));
                EXPECT_EQ(count, fit.used.size());
                EXPECT_LT(fit.deviation, 5e-5);
                EXPECT_NEAR(fit.p, p, 0.01 * p);
                EXPECT_NEAR(fit.a, a, 0.03 * a);
                EXPECT_NEAR(fit.b, b, 0.01 * b + 1e-5);
            }
}

TEST(Fit, NoiseMovesItLittleAndNothingIsBetter)
{
    const double noise[] = {0.03, -0.02, -0.03, 0.025, 0.01, -0.03, 0.02, -0.01};
    std::vector<double> errors = law(powersOfTwo, 2.0, 0.8, 0.01);
    for (size_t i = 0; i < errors.size(); ++i) errors[i] *= std::exp(noise[i]);
    const Fit fit = fitPowerLaw(powersOfTwo, errors);
    EXPECT_NEAR(fit.p, 0.8, 0.08);
    EXPECT_NEAR(fit.b, 0.01, 0.002);
    EXPECT_LT(fit.deviation, 0.03);
    const double least = squares(powersOfTwo, errors, fit.a, fit.p, fit.b);
    EXPECT_NEAR(std::sqrt(least / 8.0), fit.deviation, 1e-9);
    for (double a : {0.99, 1.0, 1.01})
        for (double p : {0.99, 1.0, 1.01})
            for (double b : {0.98, 1.0, 1.02})
                EXPECT_GE(squares(powersOfTwo, errors, a * fit.a, p * fit.p, b * fit.b), least * (1.0 - 1e-6));
}

TEST(Fit, LeavesOutWhatHasNoLogarithm)
{
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Fit fit = fitPowerLaw({0, 16, 32, 64, 128, 256, inf, -4}, {1.0, 1.0, 0.0, 0.25, nan, 0.0625, 0.1, 0.1});
    EXPECT_EQ((std::vector<size_t>{1, 3, 5}), fit.used);
    EXPECT_NEAR(fit.p, 1.0, 1e-6);
    EXPECT_NEAR(fit.at(32), 0.5, 1e-6);
}

TEST(Fit, TwoCountsAreAStraightLine)
{
    const Fit fit = fitPowerLaw({64, 16}, {0.1, 0.2});
    EXPECT_NEAR(fit.p, 0.5, 1e-12);
    EXPECT_EQ(0.0, fit.b);
    EXPECT_NEAR(fit.at(16), 0.2, 1e-12);
    // Measured twice each
    EXPECT_EQ(0.0, fitPowerLaw({16, 64, 16, 64}, {0.2, 0.1, 0.21, 0.1}).b);
}

TEST(Fit, FewerAreNone)
{
    EXPECT_FALSE(fitPowerLaw({}, {}).valid());
    EXPECT_FALSE(fitPowerLaw({16}, {0.1}).valid());
    EXPECT_FALSE(fitPowerLaw({16, 16, 16}, {0.1, 0.2, 0.3}).valid());
    EXPECT_FALSE(fitPowerLaw({16, 32}, {0.1, 0.0}).valid());
}

TEST(Fit, EqualErrorsAreAllFloor)
{
    const Fit fit = fitPowerLaw({16, 32, 64}, {0.07, 0.07, 0.07});
    EXPECT_EQ(0.0, fit.a);
    EXPECT_NEAR(fit.b, 0.07, 1e-12);
}

TEST(Fit, GrowingAndJaggedErrors)
{
    const Fit growing = fitPowerLaw({16, 32, 64}, {0.1, 0.2, 0.4});
    EXPECT_NEAR(growing.p, -1.0, 1e-9);
    EXPECT_EQ(0.0, growing.b);
    const Fit jagged = fitPowerLaw({1, 2, 3}, {0.2, 0.05, 0.1});
    EXPECT_GE(jagged.b, 0.0);
    EXPECT_GE(jagged.a, 0.0);
    EXPECT_LE(jagged.p, 4.0);
    // No worse than the mean alone
    EXPECT_LE(jagged.deviation, std::sqrt(squares({1, 2, 3}, {0.2, 0.05, 0.1}, 0.0, 1.0, 0.1) / 3.0));
}

TEST(Fit, UnitsDoNotMatter)
{
    const std::vector<double> errors = {0.31, 0.2, 0.17, 0.14};
    const Fit one = fitPowerLaw({4, 8, 16, 32}, errors);
    const Fit other = fitPowerLaw({4e6, 8e6, 16e6, 32e6}, {0.31e-9, 0.2e-9, 0.17e-9, 0.14e-9});
    EXPECT_NEAR(one.p, other.p, 1e-5);
    EXPECT_NEAR(one.b, other.b * 1e9, 1e-5);
}

}  // namespace Fit_test
