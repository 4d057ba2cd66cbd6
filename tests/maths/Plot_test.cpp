// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <locale>

#include "Plot.h"
#include "Text.h"

namespace Plot_test
{

using namespace tradeoff;

namespace
{

const double inf = std::numeric_limits<double>::infinity();
const double notANumber = std::numeric_limits<double>::quiet_NaN();

std::vector<double> ticksOf(const std::vector<double>& values, size_t most = 10)
{
    return logAxis(values, most).ticks;
}

void expectTicks(const std::vector<double>& expected, const std::vector<double>& ticks)
{
    ASSERT_EQ(expected.size(), ticks.size());
    for (size_t i = 0; i < ticks.size(); ++i) EXPECT_NEAR(ticks[i], expected[i], 1e-9 * expected[i]);
}

}  // namespace

TEST(Plot, TicksAreOneTwoFive)
{
    expectTicks({20, 50, 100, 200, 500, 1000}, ticksOf({15, 1100}));
    expectTicks({0.001, 0.01, 0.1, 1, 10}, ticksOf({0.0009, 20}, 6));
    expectTicks({400, 500, 600}, ticksOf({475, 525}, 4));
}

TEST(Plot, AxesHoldTheirValuesAndAFewTicks)
{
    const std::vector<std::vector<double>> cases = {{},
                                                    {0.0},
                                                    {notANumber, inf, -1.0},
                                                    {475.0},
                                                    {475.0, 475.0},
                                                    {470, 480},
                                                    {1, 1e12},
                                                    {1e-300, 1e300},
                                                    {0.0, 3e-5},
                                                    {5e-324, 1.7e308},
                                                    {99.9, 100},
                                                    {1e-9, 2e-9},
                                                    {0.02, 0.9}};
    for (const auto& values : cases)
        for (size_t most : {size_t(4), size_t(7), size_t(14)}) {
            SCOPED_TRACE(values.empty() ? std::string("none") : exactNumber(values.back()));
            const Axis axis = logAxis(values, most);
            EXPECT_TRUE(axis.low > 0.0 && axis.high > 1.2 * axis.low && std::isfinite(axis.high));
            EXPECT_GE(axis.ticks.size(), 2u);
            EXPECT_LE(axis.ticks.size(), most);
            for (double t : axis.ticks) EXPECT_TRUE(t >= axis.low && t <= axis.high) << t;
            for (double v : values) {
                if (v < 1e-250 || !(v < 1e250)) continue;
                EXPECT_GE(axis.place(v), 0.02);
                EXPECT_LE(axis.place(v), 0.98);
            }
        }
}

TEST(Plot, TickTexts)
{
    Axis axis;
    EXPECT_EQ("5", axis.tickText(5));
    EXPECT_EQ("0.05", axis.tickText(0.05));
    EXPECT_EQ("2000", axis.tickText(2000));
    EXPECT_EQ("10⁹", axis.tickText(1e9));
    EXPECT_EQ("5×10⁻⁷", axis.tickText(5e-7));
    axis.unit = "%";
    EXPECT_EQ("0.2 %", axis.tickText(0.002));
}

TEST(Plot, LabelsOverlapNothing)
{
    // A crowd of forty in a corner of the plot
    std::vector<Label> labels;
    std::vector<Box> obstacles;
    for (int i = 0; i < 40; ++i) {
        const double x = 60.0 + 9.0 * (i % 8);
        const double y = 60.0 + 11.0 * (i / 8);
        labels.push_back({x, y, "setting " + std::to_string(i), ""});
        obstacles.push_back({x - 4, y - 4, x + 4, y + 4});
    }
    const Box inside{40, 30, 400, 300};
    const auto boxes = placeLabels(labels, obstacles, inside);
    ASSERT_EQ(labels.size(), boxes.size());
    EXPECT_TRUE(boxes[0]);
    int placed = 0;
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i]) continue;
        ++placed;
        EXPECT_TRUE(inside.contains(*boxes[i]));
        for (const Box& o : obstacles) EXPECT_FALSE(o.overlaps(*boxes[i]));
        for (size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[k] && boxes[k]->overlaps(*boxes[i]));
    }
    EXPECT_GE(placed, 3);
    EXPECT_LT(placed, 40);
}

TEST(Plot, SpreadOutKeepsOrderAndGaps)
{
    const std::vector<double> places = {100, 100, 101, 20, 290};
    const std::vector<double> spread = spreadOut(places, 14, 10, 290);
    std::vector<double> sorted = spread;
    std::sort(sorted.begin(), sorted.end());
    for (size_t i = 1; i < sorted.size(); ++i) EXPECT_GE(sorted[i] - sorted[i - 1], 14.0 - 1e-9);
    EXPECT_GE(sorted.front(), 10.0);
    EXPECT_LE(sorted.back(), 290.0);
    EXPECT_LT(spread[0], spread[2]);
    EXPECT_EQ(20.0, spread[3]);
    EXPECT_EQ(290.0, spread[4]);
    EXPECT_LE(spreadOut({289, 289, 290}, 14, 10, 290)[2], 290.0);
}

TEST(Plot, EightMarksAreDifferent)
{
    for (size_t i = 0; i < 8; ++i)
        for (size_t k = 0; k < i; ++k) EXPECT_NE(markPath(i, 5.0), markPath(k, 5.0));
    EXPECT_EQ(markPath(3, 5.0), markPath(11, 5.0));
}

TEST(Plot, NumbersAsText)
{
    EXPECT_EQ("475", roundedNumber(475.2));
    EXPECT_EQ("47.5", roundedNumber(47.52));
    EXPECT_EQ("10.0", roundedNumber(9.999));
    EXPECT_EQ("0.00475", roundedNumber(0.004752));
    EXPECT_EQ("−0.33", roundedNumber(-1.0 / 3.0, 2));
    EXPECT_EQ("123456", roundedNumber(123456));
    EXPECT_EQ("1.23×10⁶", roundedNumber(1234567));
    EXPECT_EQ("1.00×10⁶", roundedNumber(999999.9));
    EXPECT_EQ("1.2×10⁻⁵", roundedNumber(1.2e-5, 2));
    EXPECT_EQ("1.80×10³⁰⁸", roundedNumber(1.7976e308));
    EXPECT_EQ("0", roundedNumber(0.0));
    EXPECT_EQ("–", roundedNumber(notANumber));
    EXPECT_EQ("–", roundedNumber(inf));
    EXPECT_EQ("2.1\u00a0%", percent(0.0213));
    EXPECT_EQ("8.00\u00a0ms", milliseconds(8.0));
    EXPECT_EQ("0.1", exactNumber(0.1));
    EXPECT_EQ("", exactNumber(notANumber));
    EXPECT_EQ("&lt;b&gt; &amp; &quot;&#39;ü", escaped("<b> & \"'ü"));
    EXPECT_EQ(2u, letters("ü½"));
}

TEST(Plot, TheLocaleChangesNothing)
{
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const std::locale former = std::locale::global(std::locale(std::locale::classic(), new Comma));
    EXPECT_EQ("47.5", roundedNumber(47.52));
    EXPECT_EQ("0.25", exactNumber(0.25));
    EXPECT_EQ("1500.50", coordinate(1500.5));
    std::locale::global(former);
}

}  // namespace Plot_test
