// SPDX-License-Identifier: MIT
#include <osg/Math>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "glsl.h"

namespace atlas_test
{

namespace
{

const double texel = 1.0 / 128.0;

}  // namespace

TEST(atlas, NothingThereHidesNothing)
{
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0, 1.0, 0.0, texel));
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0, 0.5, 3.0, texel));
}

TEST(atlas, HalfWayBetweenTheSurfacesOfABody)
{
    EXPECT_DOUBLE_EQ(0.6, glsl::midpointHeight(0.2, 0.6, 0.0, texel));
    // A slope within the body changes nothing.
    EXPECT_DOUBLE_EQ(0.6, glsl::midpointHeight(0.2, 0.6, 2.0 * texel, texel));
}

TEST(atlas, OpenSurfacesAreLetDownByTheirSlopeUpToALimit)
{
    const double first = 0.7;
    // One behind another: a texel at most.
    EXPECT_DOUBLE_EQ(first - 0.71 * texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, texel, texel));
    EXPECT_DOUBLE_EQ(first - texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, 10.0 * texel, texel));
    // None behind, or a sheet: three.
    EXPECT_DOUBLE_EQ(first - 3.0 * texel, glsl::midpointHeight(1.0 - first, 1.0, 10.0 * texel, texel));
    EXPECT_DOUBLE_EQ(first - 3.0 * texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, -10.0 * texel, texel));
    EXPECT_DOUBLE_EQ(first, glsl::midpointHeight(1.0 - first, 1.0, 0.0, texel));
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0 - 1e-3, 1.0, 10.0 * texel, texel));  // the map's own floor
}

TEST(atlas, PointsAreLookedUpOffTheSurfaceWhereLightGrazes)
{
    const glsl::vec3 p(1, 2, 3), n(0, 0, 1);
    EXPECT_EQ(p, glsl::atlasLookupPoint(p, n, 1.0, texel));
    EXPECT_NEAR(3.0 + 0.1 * texel, glsl::atlasLookupPoint(p, n, 0.0, texel).z, 1e-15);
    EXPECT_NEAR(3.0 + 0.08 * texel, glsl::atlasLookupPoint(p, n, 0.6, texel).z, 1e-15);
}

TEST(atlas, MapsOfTheSkyKeepTheMiddleOfBodies)
{
    const double first = 0.7;
    const auto height = [&](double secondHeight, double slope, double back) {
        return glsl::skyHeight(1.0 - first, 1.0 - secondHeight, slope, back, texel);
    };
    EXPECT_EQ(0.0, glsl::skyHeight(1.0, 1.0, 0.0, 0.0, texel));
    EXPECT_DOUBLE_EQ(0.5, height(0.3, 0.0, 1.0));
    EXPECT_DOUBLE_EQ(first, height(0.0, 0.0, 0.0));
    // Down to a texel where what is behind is another body.
    EXPECT_DOUBLE_EQ(first - 0.5 * texel, height(first - texel, 0.0, 0.0));
    EXPECT_DOUBLE_EQ(first - texel, height(0.1, 0.0, 0.0));
    // A tenth of a texel and a little of the slope where the light grazes it, and no more for a sheet.
    EXPECT_DOUBLE_EQ(first - 0.2 * texel, height(0.0, 2.0 * texel, 0.0));
    EXPECT_DOUBLE_EQ(first - 0.2 * texel, height(0.1, -2.0 * texel, 1.0));
    EXPECT_DOUBLE_EQ(first - 0.71e-3 * texel, height(0.0, 1e-3 * texel, 0.0));
    EXPECT_EQ(0.0, glsl::skyHeight(1.0 - 1e-4, 1.0, 10.0 * texel, 0.0, texel));  // the map's own floor
}

TEST(atlas, PlanesRiseToTheTexelsCentre)
{
    // Of height 2 x - 3 y: its normal is (-2, 3, 1).
    EXPECT_NEAR(2.0 * (5.5 - 5.2) - 3.0 * (7.5 - 7.9), glsl::riseToCentre(glsl::vec3(-2, 3, 1), glsl::vec2(5.2, 7.9)), 1e-12);
    EXPECT_EQ(0.0, glsl::riseToCentre(glsl::vec3(-2, 3, 1), glsl::vec2(5.5, 7.5)));
    EXPECT_EQ(0.0, glsl::riseToCentre(glsl::vec3(0, 0, 1), glsl::vec2(5.1, 7.2)));
    EXPECT_TRUE(std::isfinite(glsl::riseToCentre(glsl::vec3(1, 0, 0), glsl::vec2(5.1, 7.2))));
}

TEST(atlas, VisibleAtOrAboveTheMapsHeightAndOutsideIt)
{
    const float heights[] = {0.5f, 0, 0, 0, 0.25f, 0, 0, 0, 0.0f, 0, 0, 0, 1.0f, 0, 0, 0};
    const glsl::sampler2D map{heights, 2, 2};
    const auto sees = [&](double x, double y, double height) {
        return glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(x, y), height, 0.0);
    };
    EXPECT_EQ(1.0, sees(0.5, 0.5, 0.5));
    EXPECT_EQ(0.0, sees(0.5, 0.5, 0.4999));
    EXPECT_EQ(1.0, sees(1.5, 0.5, 0.3));
    EXPECT_EQ(0.0, sees(1.5, 1.5, 0.9));
    EXPECT_EQ(1.0, sees(2.5, 1.5, 0.0));
    EXPECT_EQ(1.0, sees(-0.5, 1.5, 0.0));
}

TEST(atlas, TheRiseOfAPlaneCountsAsFarAsTheFirstSurfaceRises)
{
    const double slope = std::exp2(-3.25);  // one that a byte holds
    const float heights[] = {0.5f, float(glsl::packedRise(slope, 0.0)), 0, 0};
    const glsl::sampler2D map{heights, 1, 1};
    const auto sees = [&](double below, double rise) {
        return glsl::atlasVisible(map, glsl::ivec2(0, 0), 1, glsl::vec2(0.5, 0.5), 0.5 - below, rise);
    };
    EXPECT_EQ(1.0, sees(0.03, 0.03));
    EXPECT_EQ(0.0, sees(0.03, 0.02));
    EXPECT_EQ(0.0, sees(0.08, 0.08));  // more than .71 of the slope
    EXPECT_EQ(1.0, sees(0.0, -0.03));  // lower at the centre: the point is not
}

// Half a step of either byte: 1/32 of an octave, and 1/512 of the way round a square, 8/512 radians in the middle of a side.
TEST(atlas, TheRiseOfTheFirstSurfaceIsKeptInTwoBytes)
{
    for (double slope : {std::exp2(-15.9), 1e-4, 0.0078, 0.3, 1.0})
        for (int degrees = 0; degrees < 360; ++degrees) {
            const double a = osg::DegreesToRadians(double(degrees));
            const glsl::vec2 gradient = slope * glsl::vec2(std::cos(a), std::sin(a));
            const float kept = float(glsl::packedRise(slope, glsl::turnOf(gradient)));
            ASSERT_TRUE(kept >= 0.0f && kept <= 1.0f);
            const glsl::vec2 back = glsl::unpackedRise(kept);
            EXPECT_LE(std::abs(std::log2(glsl::length(back) / slope)), 1.0 / 32.0 + 1e-6) << slope << " at " << degrees;
            EXPECT_GE(glsl::dot(back, gradient) / (slope * glsl::length(back)), std::cos(8.0 / 512.0) - 1e-9) << degrees;
        }
    EXPECT_EQ(glsl::vec2(0.0, 0.0), glsl::unpackedRise(glsl::packedRise(0.0, glsl::turnOf(glsl::vec2(0.0, 0.0)))));
    // Steeper than the map is high in a texel: as that.
    EXPECT_DOUBLE_EQ(1.0, glsl::length(glsl::unpackedRise(glsl::packedRise(30.0, 0.0))));
}

TEST(atlas, NothingIsSeenFromUnderASurfaceThatGoesOnInTheNextTexel)
{
    const int size = 16;
    std::vector<float> texels(size_t(size) * size * 4, 0.0f);
    const double slope = std::exp2(-4.0);  // rises to the right
    const double slack = 0.1 / size + 5e-5;
    const auto put = [&](size_t x, double height) {
        texels[4 * x] = float(height);
        texels[4 * x + 1] = float(glsl::packedRise(slope, glsl::turnOf(glsl::vec2(1.0, 0.0))));
    };
    const auto sees = [&](double x, double height) {
        const glsl::sampler2D map{texels.data(), size, size};
        return glsl::atlasVisible(map, glsl::ivec2(0, 0), size, glsl::vec2(x, 0.5), height, 1.0);
    };
    put(0, 0.5);
    put(1, 0.5 + slope);
    EXPECT_EQ(1.0, sees(0.9, 0.5 + 0.4 * slope - 0.99 * slack));
    EXPECT_EQ(0.0, sees(0.9, 0.5 + 0.4 * slope - 1.01 * slack));
    // On its low side the middle decides, and the rise of the point's own plane.
    EXPECT_EQ(1.0, sees(0.1, 0.5 - 0.4 * slope));
    EXPECT_EQ(0.0, sees(0.1, 0.5 - 0.75 * slope));
    // A body's edge: the next texel shows its other side.
    put(1, 0.5);
    EXPECT_EQ(1.0, sees(0.9, 0.5 + 0.4 * slope - 1.5 * slack));
}

}  // namespace atlas_test
