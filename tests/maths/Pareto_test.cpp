// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "Pareto.h"

namespace Pareto_test
{

using namespace tradeoff;

namespace
{

Point point(double milliseconds, double error)
{
    Point p;
    p.settings = {{"samples", "1"}};
    p.frame.median = milliseconds;
    p.beauty.tRMSE = error;
    return p;
}

Point failed(double milliseconds, double error)
{
    Point p = point(milliseconds, error);
    p.failed = true;
    return p;
}

std::vector<Point> pointsOf(const std::vector<std::pair<double, double>>& places)
{
    std::vector<Point> points;
    for (const auto& [ms, error] : places) points.push_back(point(ms, error));
    return points;
}

using Indices = std::vector<size_t>;

const std::vector<Point> bent = pointsOf({{10, 0.4}, {12, 0.1}, {40, 0.08}, {160, 0.06}});

}  // namespace

TEST(Pareto, FrontByTime)
{
    const std::vector<Point> points = pointsOf({{30, 0.1}, {10, 0.4}, {20, 0.2}, {20, 0.3}, {40, 0.1}, {50, 0.05}, {9, 0.5}});
    EXPECT_EQ((Indices{6, 1, 2, 0, 5}), paretoFront(points));
    for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(i == 3 || i == 4, isDominated(points, i)) << i;
}

TEST(Pareto, EqualPointsDoNotDominateEachOther)
{
    const std::vector<Point> points = pointsOf({{10, 0.1}, {10, 0.1}, {10, 0.1}});
    EXPECT_EQ(Indices{0}, paretoFront(points));
    for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(isDominated(points, i));
}

TEST(Pareto, WhatWasNotMeasuredHasNoSay)
{
    const std::vector<Point> points = {failed(1, 0.01), point(unknown, 0.01), point(1, unknown), point(0, 0.01), point(10, 0.2)};
    EXPECT_EQ(Indices{4}, paretoFront(points));
    for (size_t i = 0; i < points.size(); ++i) EXPECT_FALSE(isDominated(points, i));
    EXPECT_EQ(Choice(4), kneeOf(points));
    EXPECT_EQ(Choice(4), cheapestWithin(points, 1.0));
    EXPECT_EQ(Choice(), kneeOf({}));
    EXPECT_EQ(Choice(), kneeOf({failed(1, 0.1)}));
}

TEST(Pareto, UnresolvedErrorsAreTheNoise)
{
    std::vector<Point> points = pointsOf({{10, 0.003}, {20, 0.001}});
    for (Point& p : points) {
        p.beauty.noise = 0.01;
        p.beauty.resolved = false;
    }
    EXPECT_EQ(0.01, points[1].beauty.error());
    EXPECT_EQ(Indices{0}, paretoFront(points));
}

TEST(Pareto, KneeIsFarthestBelowTheChord)
{
    EXPECT_EQ(Choice(1), kneeOf(bent));
    // ln error = x^2 - 2.5 x falls over -1 < x < 1 and is a parabola, which is farthest below its chord in the middle.
    std::vector<std::pair<double, double>> places;
    for (int i = 0; i <= 40; ++i) {
        const double x = (i - 20) / 20.0;
        places.emplace_back(std::exp(x), std::exp(x * x - 2.5 * x));
    }
    EXPECT_EQ(Choice(20), kneeOf(pointsOf(places)));
}

TEST(Pareto, KneeDoesNotDependOnUnitsOrDominatedPoints)
{
    for (auto [time, error] : {std::pair(1000.0, 1.0), std::pair(1.0, 100.0), std::pair(1e-9, 1e9)}) {
        std::vector<Point> scaled;
        for (const Point& p : bent) scaled.push_back(point(time * p.frame.median, error * p.beauty.error()));
        EXPECT_EQ(Choice(1), kneeOf(scaled));
    }
    std::vector<Point> more = bent;
    for (double ms : {11.0, 50.0, 1e6}) more.push_back(point(ms, 0.5));
    more.push_back(point(13, 0.1));
    EXPECT_EQ(Choice(1), kneeOf(more));
}

TEST(Pareto, KneeOfShortAndStraightFronts)
{
    EXPECT_EQ(Choice(0), kneeOf(pointsOf({{10, 0.1}})));
    // Twice the time for a third of the error, and for nearly all of it
    EXPECT_EQ(Choice(1), kneeOf(pointsOf({{10, 0.3}, {20, 0.1}})));
    EXPECT_EQ(Choice(0), kneeOf(pointsOf({{10, 0.3}, {20, 0.29}})));
    EXPECT_EQ(Choice(0), kneeOf(pointsOf({{10, 0.2}, {20, 0.1}})));
    EXPECT_EQ(Choice(0), kneeOf(pointsOf({{10, 0.4}, {20, 0.2}, {40, 0.1}})));
    // Bent the other way
    EXPECT_EQ(Choice(2), kneeOf(pointsOf({{10, 0.4}, {20, 0.39}, {40, 0.01}})));
}

TEST(Pareto, KneeWithAnErrorOfZero)
{
    // 0 counts as .01: the chord from (10, .4) to (160, .01) leaves the point at 12 below it.
    EXPECT_EQ(Choice(1), kneeOf(pointsOf({{10, 0.4}, {12, 0.1}, {160, 0.0}})));
    EXPECT_EQ(Choice(0), kneeOf(pointsOf({{10, 0.0}, {20, 0.0}})));
}

TEST(Pareto, Targets)
{
    const std::vector<Point> points = pointsOf({{30, 0.1}, {10, 0.4}, {20, 0.2}, {20, 0.3}, {40, 0.1}, {10, 0.5}});
    EXPECT_EQ(Choice(2), cheapestWithin(points, 0.3));
    EXPECT_EQ(Choice(0), cheapestWithin(points, 0.1 + 1e-12));
    EXPECT_EQ(Choice(), cheapestWithin(points, 0.05));
    EXPECT_EQ(Choice(1), cheapestWithin(points, 1.0));
    EXPECT_EQ(Choice(2), mostExactWithin(points, 20.0));
    EXPECT_EQ(Choice(0), mostExactWithin(points, 1e9));
    EXPECT_EQ(Choice(), mostExactWithin(points, 9.0));
    EXPECT_EQ(Choice(2), answerTo({Target::ERROR, 0.3}, points));
    EXPECT_EQ(Choice(1), answerTo({Target::MILLISECONDS, 15.0}, points));
}

TEST(Pareto, DefaultIsTheFirstWithoutSettings)
{
    std::vector<Point> points = pointsOf({{30, 0.1}, {10, 0.4}, {20, 0.2}});
    EXPECT_EQ(Choice(), defaultOf(points));
    points[1].settings.clear();
    points[2].settings.clear();
    EXPECT_EQ(Choice(1), defaultOf(points));
    points[1].failed = true;
    EXPECT_EQ(Choice(2), defaultOf(points));
}

}  // namespace Pareto_test
