// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace bilateral_test
{

using namespace testmaths;

TEST(bilateral, EveryGroupOfTheCellWeighsTheSame)
{
    for (int cells = 1; cells <= 8; ++cells)
        for (int centre = 0; centre < 4; ++centre) {
            double weight[4] = {};
            for (int i = -2 * cells; i <= 2 * cells; ++i) weight[((centre + i) % 4 + 4) % 4] += glsl::cellWeight(i, 2 * cells);
            for (double w : weight) EXPECT_EQ(w, cells) << cells << " " << centre;
        }
}

TEST(bilateral, SurfaceWeight)
{
    EXPECT_EQ(glsl::surfaceWeight(0.0, 1.0), 1.0);
    // A unit off the plane, either side: 1/e
    for (double side : {1.0, -1.0}) EXPECT_NEAR(glsl::surfaceWeight(side, 1.0), std::exp(-1.0), 1e-15);
    // Normals at 60 degrees: cos^32
    EXPECT_NEAR(glsl::surfaceWeight(0.0, 0.5) / std::ldexp(1.0, -32), 1.0, 1e-12);
    EXPECT_EQ(glsl::surfaceWeight(0.0, -1.0), 0.0);
    EXPECT_EQ(glsl::surfaceWeight(1e30, 1.0), 0.0);
}

TEST(bilateral, FallsWithDistanceAndAngle)
{
    double before = 2.0;
    for (int i = 0; i <= 100; ++i) {
        const double w = glsl::surfaceWeight(0.04 * i, 1.0);
        EXPECT_LT(w, before);
        before = w;
    }
    before = 2.0;
    for (int i = 0; i < 90; ++i) {
        const double w = glsl::surfaceWeight(0.0, std::cos(i * pi / 180.0));
        EXPECT_LT(w, before);
        before = w;
    }
}

TEST(bilateral, LobesOfTurnedNormalsCountByTheirWidth)
{
    for (const double roughness : {0.05, 0.2, 0.6, 1.0}) {
        const double narrowness = glsl::lobeNarrowness(roughness, 0.5);
        EXPECT_EQ(glsl::lobeWeight(0.0, narrowness), 1.0);
        EXPECT_NEAR(glsl::lobeWeight(0.5 * roughness * roughness, narrowness), std::exp(-1.0), 1e-12) << roughness;
    }
    EXPECT_NEAR(glsl::lobeTurn(glsl::vec3(0.03, 0.0, 0.04), 0.02), 0.06, 1e-15);
    EXPECT_TRUE(std::isfinite(glsl::lobeNarrowness(0.0, 0.5)));
    EXPECT_EQ(glsl::alikeWeight(0.0), 1.0);
    EXPECT_NEAR(glsl::alikeWeight(0.1), std::exp(-1.0), 1e-12);
    EXPECT_EQ(glsl::alikeWeight(0.1), glsl::alikeWeight(-0.1));
}

}  // namespace bilateral_test
