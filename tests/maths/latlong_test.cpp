// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace latlong_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

// A few roundings of double on numbers of order 1.
constexpr double rounding = 1e-14;

TEST(latlong, Convention)
{
    const std::pair<vec3, vec2> table[] = {{vec3(1, 0, 0), vec2(0.5, 0.5)},  {vec3(0, -1, 0), vec2(0.75, 0.5)},
                                           {vec3(0, 1, 0), vec2(0.25, 0.5)}, {vec3(0, 0, 1), vec2(0.5, 0.0)},
                                           {vec3(0, 0, -1), vec2(0.5, 1.0)}, {vec3(1, 0, 1), vec2(0.5, 0.25)}};
    for (const auto& [d, uv] : table) {
        const vec2 found = glsl::latlongFromDirection(d);
        EXPECT_NEAR(found.x, uv.x, rounding);
        EXPECT_NEAR(found.y, uv.y, rounding);
    }
}

TEST(latlong, SeamLiesAlongMinusX)
{
    EXPECT_NEAR(glsl::latlongFromDirection(vec3(-1, 1e-12, 0)).x, 0.0, 1e-12);
    EXPECT_NEAR(glsl::latlongFromDirection(vec3(-1, -1e-12, 0)).x, 1.0, 1e-12);
    for (double y : {0.0, -0.0}) {
        const double u = glsl::latlongFromDirection(vec3(-1, y, 0)).x;
        EXPECT_TRUE(u == 0.0 || u == 1.0) << u;
    }
}

TEST(latlong, RoundTrip)
{
    Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const vec2 uv = random.square();
        const vec3 d = glsl::directionFromLatlong(uv);
        EXPECT_NEAR(glsl::length(d), 1.0, rounding);
        const vec2 back = glsl::latlongFromDirection(d * random.uniform(1e-3, 1e3));
        // Near the poles the azimuth keeps what sin(theta) leaves of the digits.
        EXPECT_NEAR(back.x, uv.x, rounding / std::sin(pi * uv.y));
        EXPECT_NEAR(back.y, uv.y, rounding);
    }
}

TEST(latlong, PolarAngleKeepsItsDigitsAtThePole)
{
    for (double x : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const double v = glsl::latlongFromDirection(vec3(x, 0, 1)).y;
        EXPECT_NEAR(v / (std::atan(x) / pi), 1.0, rounding);
    }
}

TEST(latlong, FiniteAndInRangeEverywhere)
{
    for (double x : {0.0, -0.0, 1e-300, -1e-300, 1.0, -1.0})
        for (double y : {0.0, -0.0, 1e-300, -1e-300, 1.0, -1.0})
            for (double z : {1.0, -1.0, 1e-300}) {
                const vec2 uv = glsl::latlongFromDirection(vec3(x, y, z));
                EXPECT_GE(uv.x, 0.0);
                EXPECT_LE(uv.x, 1.0);
                EXPECT_GE(uv.y, 0.0);
                EXPECT_LE(uv.y, 1.0);
            }
}

TEST(latlong, SolidAnglesSumToTheSphere)
{
    for (vec2 size : {vec2(1, 1), vec2(2, 1), vec2(4, 2), vec2(1024, 512), vec2(16384, 8192)}) {
        double sum = 0.0;
        for (int y = 0; y < int(size.y); ++y) sum += glsl::latlongTexelSolidAngle(y, size) * size.x;
        // Relative rounding of a sum of up to 8192 terms: at most 8192 * 1.1e-16
        EXPECT_NEAR(sum / (4.0 * pi), 1.0, 1e-12) << size.x;
    }
}

TEST(latlong, SolidAngleOfATexel)
{
    const vec2 size(64, 32);
    for (int y = 0; y < 32; ++y) {
        const double exact = 2.0 * pi / 64.0 * (std::cos(pi * y / 32.0) - std::cos(pi * (y + 1) / 32.0));
        EXPECT_NEAR(glsl::latlongTexelSolidAngle(y, size), exact, 1e-16);
    }
    // At the pole of a large map cos - cos loses 7 digits: there 1 - cos t = 2 sin^2(t/2).
    const double s = std::sin(0.5 * pi / 8192.0);
    EXPECT_NEAR(glsl::latlongTexelSolidAngle(0, vec2(16384, 8192)) / (2.0 * pi / 16384.0 * 2.0 * s * s), 1.0, rounding);
}

}  // namespace latlong_test
