// SPDX-License-Identifier: MIT
// lib/metering.glsl
#include "glsl.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

double stopsOf(double white, double base = 0.0)
{
    return glsl::meteredStops(glsl::meteredLight(white, 1.0), base);
}

}  // namespace

TEST(Metering, LeavesWhiteWhereItMayBeShown)
{
    for (double stops = glsl::LEAST_STOPS; stops <= glsl::MOST_STOPS; stops += 0.125)
        EXPECT_NEAR(0.0, stopsOf(glsl::METERED_WHITE * std::exp2(stops)), 1e-12) << stops;
    EXPECT_NEAR(3.0, stopsOf(glsl::METERED_WHITE * std::exp2(glsl::LEAST_STOPS - 3.0)), 1e-12);
    EXPECT_NEAR(-3.0, stopsOf(glsl::METERED_WHITE * std::exp2(glsl::MOST_STOPS + 3.0)), 1e-12);
    EXPECT_NEAR(3.0, stopsOf(glsl::METERED_WHITE * std::exp2(glsl::LEAST_STOPS - 7.0), 4.0), 1e-12);
}

TEST(Metering, IsThatOfWhiteWhateverASurfaceReflects)
{
    for (const double reflectance : {0.12, 0.2, 0.5, 1.0}) {
        const glsl::vec2 light = glsl::meteredLight(3.0 * reflectance, reflectance);
        EXPECT_DOUBLE_EQ(1.0, light.x);
        EXPECT_NEAR(std::sqrt(3.0), light.y, 1e-12);
    }
    for (const double reflectance : {0.0, 0.04, glsl::LEAST_METERED}) EXPECT_EQ(0.0, glsl::meteredLight(3.0, reflectance).x);
}

TEST(Metering, ExtremesHaveLimits)
{
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(glsl::MOST_ADAPTED, stopsOf(0.0));
    EXPECT_EQ(glsl::MOST_ADAPTED, stopsOf(-1.0));
    EXPECT_EQ(-glsl::MOST_ADAPTED, stopsOf(1e29));
    for (const double sent : {infinity, std::numeric_limits<double>::quiet_NaN()}) {
        const glsl::vec2 light = glsl::meteredLight(sent, 0.5);
        EXPECT_EQ(0.0, light.x);
        EXPECT_EQ(0.0, light.y);
    }
}

TEST(Metering, ASmallBrightPatchDoesNotDecide)
{
    const glsl::vec2 room = 0.98 * glsl::meteredLight(0.01, 1.0);
    const glsl::vec2 sun = 0.02 * glsl::meteredLight(1.0, 1.0);
    EXPECT_NEAR(glsl::meteredStops(room, 0.0), glsl::meteredStops(room + sun, 0.0), 0.5);
}
