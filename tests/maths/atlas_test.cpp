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
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0, 1.0, 0.0, 1.0, texel));
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0, 0.5, 3.0, 1.0, texel));
}

TEST(atlas, HalfWayBetweenTheSurfacesOfABody)
{
    EXPECT_DOUBLE_EQ(0.6, glsl::midpointHeight(0.2, 0.6, 0.0, 1.0, texel));
    // A slope within the body changes nothing.
    EXPECT_DOUBLE_EQ(0.6, glsl::midpointHeight(0.2, 0.6, 2.0 * texel, 1.0, texel));
}

TEST(atlas, OpenSurfacesAreLetDownByTheirSlopeUpToALimit)
{
    const double first = 0.7;
    // One behind another: a texel at most.
    EXPECT_DOUBLE_EQ(first - 0.71 * texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, texel, 1.0, texel));
    EXPECT_DOUBLE_EQ(first - texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, 10.0 * texel, 1.0, texel));
    // None behind, or a sheet: three.
    EXPECT_DOUBLE_EQ(first - 3.0 * texel, glsl::midpointHeight(1.0 - first, 1.0, 10.0 * texel, 1.0, texel));
    EXPECT_DOUBLE_EQ(first - 3.0 * texel, glsl::midpointHeight(1.0 - first, 1.0 - first + 1e-4, -10.0 * texel, 1.0, texel));
    EXPECT_DOUBLE_EQ(first, glsl::midpointHeight(1.0 - first, 1.0, 0.0, 1.0, texel));
    EXPECT_EQ(0.0, glsl::midpointHeight(1.0 - 1e-3, 1.0, 10.0 * texel, 1.0, texel));  // the map's own floor
}

TEST(atlas, WhatLiesBehindASheetIsNotTheSheet)
{
    for (const double slope : {-10.0 * texel, 0.0, 10.0 * texel})
        EXPECT_DOUBLE_EQ(0.7 - 0.5e-4, glsl::midpointHeight(0.3, 0.3 + 1e-4, slope, 0.0, texel));
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

TEST(atlas, NormalsTellHowPlanesRise)
{
    // Of height 2 x - 3 y: its normal is (-2, 3, 1).
    EXPECT_EQ(glsl::vec2(2, -3), glsl::planeGradient(glsl::vec3(-2, 3, 1)));
    EXPECT_EQ(glsl::vec2(0, 0), glsl::planeGradient(glsl::vec3(0, 0, 1)));
    EXPECT_TRUE(std::isfinite(glsl::planeGradient(glsl::vec3(1, 0, 0)).x));
}

TEST(atlas, VisibleAtOrAboveTheMapsHeightAndOutsideIt)
{
    const float heights[] = {0.5f, 0, 0, 0, 0.25f, 0, 0, 0, 0.0f, 0, 0, 0, 1.0f, 0, 0, 0};
    const glsl::sampler2D map{heights, 2, 2};
    const auto sees = [&](double x, double y, double height) {
        return glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(x, y), height, glsl::vec2(0.0, 0.0));
    };
    EXPECT_EQ(1.0, sees(0.5, 0.5, 0.5));
    EXPECT_EQ(0.0, sees(0.5, 0.5, 0.4999));
    EXPECT_EQ(1.0, sees(1.5, 0.5, 0.3));
    EXPECT_EQ(0.0, sees(1.5, 1.5, 0.9));
    EXPECT_EQ(1.0, sees(2.5, 1.5, 0.0));
    EXPECT_EQ(1.0, sees(-0.5, 1.5, 0.0));
}

TEST(atlas, BelowAllThatAMapShowsWhatItShowsShades)
{
    const float heights[] = {0.5f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const glsl::sampler2D map{heights, 2, 2};
    for (const double height : {-1e-3, -1.0, -1e4})
        for (const double slope : {0.0, 0.5, -20.0}) {
            const auto sees = [&](double x, double y) {
                return glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(x, y), height, glsl::vec2(slope, 0.0));
            };
            EXPECT_EQ(0.0, sees(0.9, 0.9)) << height << ", " << slope;
            EXPECT_EQ(1.0, sees(1.1, 0.9)) << height << ", " << slope;
            EXPECT_EQ(1.0, sees(0.9, 1.1)) << height << ", " << slope;
        }
}

// Two texels of a map. Heights fall to the right by this much a texel.
struct AtlasPair {
    static const int size = 16;
    const double slope = std::exp2(-4.0);  // one that a byte holds
    const double least = glsl::leastDrop(slope, 1.0 / size);
    const double slack = 0.01 * (1.0 / size + slope) + 5e-5;
    std::vector<float> texels = std::vector<float>(size_t(size) * size * 4, 0.0f);

    void put(size_t x, double first) { put(x, first, slope); }

    void put(size_t x, double first, double fall)
    {
        texels[4 * x] = float(first - glsl::leastDrop(fall, 1.0 / size));
        texels[4 * x + 1] = float(glsl::packedRise(fall, glsl::turnOf(glsl::vec2(-1.0, 0.0))));
    }

    double sees(double x, double height, const glsl::vec2& plane) const
    {
        const glsl::sampler2D map{texels.data(), size, size};
        return glsl::atlasVisible(map, glsl::ivec2(0, 0), size, glsl::vec2(x, 0.5), height, plane);
    }
};

// The point lies at the right of a texel, where its plane is lower than in the middle of the texel.
TEST(atlas, TheRiseOfAPlaneCountsAsFarAsTheFirstSurfaceRises)
{
    AtlasPair map;
    const double first = 0.5, x = 1.0 - 1e-6;
    map.put(0, first);
    const auto sees = [&](double below, double rise) { return map.sees(x, first - below, glsl::vec2(-2.0 * rise, 0.0)); };
    EXPECT_EQ(1.0, sees(0.5 * map.slope, 0.5 * map.slope));
    EXPECT_EQ(0.0, sees(0.5 * map.slope, 0.3 * map.slope));
    EXPECT_EQ(0.0, sees(map.slope, map.slope));         // more than .71 of the slope
    EXPECT_EQ(1.0, sees(0.5 * map.least, -map.slope));  // higher than the middle, whatever its plane does
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

// A wall faces the right and stands on a floor, whose lower side the map shows.
TEST(atlas, NoLightReachesTheFootOfAWallFromUnderTheFloor)
{
    AtlasPair map;
    const double first = 0.5;
    map.put(0, first);
    map.put(1, first - map.slope);
    const glsl::vec2 wall(-100.0 * map.slope, 0.0);
    const auto floorAt = [&](double x) { return first - map.slope * (x - 0.5); };
    for (double x : {0.2, 0.45, 0.55, 0.8}) {
        EXPECT_EQ(0.0, map.sees(x, floorAt(x) - 1.01 * map.slack, wall)) << x;
        EXPECT_EQ(1.0, map.sees(x, floorAt(x) - 0.99 * map.slack, wall)) << x;
        EXPECT_EQ(1.0, map.sees(x, floorAt(x) + 0.01, wall)) << x;
    }
    // Where the floor ends at the wall, nothing is before it.
    AtlasPair edge;
    edge.put(0, first);
    EXPECT_EQ(0.0, edge.sees(0.1, floorAt(0.1) - 1.01 * edge.slack, wall));
    EXPECT_EQ(1.0, edge.sees(0.8, floorAt(0.8) - 1.01 * edge.slack, wall));
}

// A wall that faces the light is level in the map. The floor below rises from it to the left, and ends or goes on to the right.
TEST(atlas, NoLightFromUnderTheFloorReachesAWallThatFacesIt)
{
    AtlasPair map, edge;
    const double height = 0.5, foot = 1.4, x = 1.2;
    const glsl::vec2 wall(0.0, 0.0);
    const auto floorAt = [&](double at) { return height + map.slope * (foot - at); };
    map.put(0, floorAt(0.5));
    map.put(1, floorAt(1.5));
    EXPECT_EQ(0.0, map.sees(x, height, wall));
    EXPECT_EQ(1.0, map.sees(x, floorAt(x) + map.slack, wall));
    edge.put(0, floorAt(0.5));
    EXPECT_EQ(0.0, edge.sees(x, height, wall));
    EXPECT_EQ(1.0, edge.sees(x, floorAt(x) + edge.slack, wall));
    EXPECT_EQ(1.0, edge.sees(1.8, height, wall));  // beyond the foot
}

// A point is under the planes of the other sides of its own body: they are not before its own side.
TEST(atlas, ABodyDoesntShadeItsSidesBesideAnEdge)
{
    AtlasPair map;
    const double first = 0.5;
    map.put(0, first);
    map.put(1, first - 2.0 * map.slope);  // the other side is steeper
    const glsl::vec2 steeper(-2.0 * map.slope, 0.0);
    for (double x : {0.55, 0.7, 0.9}) EXPECT_EQ(1.0, map.sees(x, first - 2.0 * map.slope * (x - 0.5), steeper)) << x;
    // A surface is not under its own plane.
    const glsl::vec2 own(-map.slope, 0.0);
    map.put(1, first - map.slope);
    for (double x : {0.05, 0.5, 0.95, 1.4}) EXPECT_EQ(1.0, map.sees(x, first - map.slope * (x - 0.5), own)) << x;
}

// The next texel shows another body, three texels higher and steep: its plane meets the point's own plane within a texel, as a
// floor's would. This texel shows the point's own body, whose middle the map keeps.
TEST(atlas, ABodyNearerTheLightDoesntShadeTheTexelBesideIt)
{
    AtlasPair map;
    const double height = 0.5, x = 1.2;
    const glsl::vec2 own(-map.slope, 0.0);
    map.put(0, height + 3.0 / map.size, 4.0 * map.slope);
    map.put(1, height - 3.0 / map.size);
    EXPECT_EQ(1.0, map.sees(x, height, own));
    map.put(1, 0.0);  // if nothing is there, it may be a floor that meets a wall
    EXPECT_EQ(0.0, map.sees(x, height, own));
}

// A board with a rim: the rim's outer side is before the board, but the light comes in over it.
TEST(atlas, ALowRimDoesntShadeWhatLiesWithinIt)
{
    AtlasPair map;
    const glsl::vec2 board(-0.5 * map.slope, 0.0);
    const double height = 0.5, x = 0.55, atCentre = height + (x - 0.5) * 0.5 * map.slope;
    map.put(0, atCentre + 0.14 / map.size);
    EXPECT_EQ(1.0, map.sees(x, height, board));
    map.put(0, atCentre + 0.5 / map.size);
    EXPECT_EQ(0.0, map.sees(x, height, board));
}

}  // namespace atlas_test
