// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "glsl.h"

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

TEST(atlas, VisibleAtOrAboveTheMapsHeightAndOutsideIt)
{
    const float heights[] = {0.5f, 0, 0, 0, 0.25f, 0, 0, 0, 0.0f, 0, 0, 0, 1.0f, 0, 0, 0};
    const glsl::sampler2D map{heights, 2, 2};
    EXPECT_EQ(1.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(0.5, 0.5), 0.5));
    EXPECT_EQ(0.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(0.5, 0.5), 0.4999));
    EXPECT_EQ(1.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(1.5, 0.5), 0.3));
    EXPECT_EQ(0.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(1.5, 1.5), 0.9));
    EXPECT_EQ(1.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(2.5, 1.5), 0.0));
    EXPECT_EQ(1.0, glsl::atlasVisible(map, glsl::ivec2(0, 0), 2, glsl::vec2(-0.5, 1.5), 0.0));
}
