// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace colorbox_test
{

using namespace testmaths;
using glsl::vec3;

TEST(colorbox, OpponentColorsAreThereAndBack)
{
    for (const vec3& c : {vec3(0.0), vec3(1.0), vec3(0.2, 0.7, 0.4), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], glsl::rgbFromOpponent(glsl::opponentFromRgb(c))[k], 1e-15);
}

// A grey has luma alone.
TEST(colorbox, GreysHaveNoColor)
{
    const vec3 c = glsl::opponentFromRgb(vec3(0.3));
    EXPECT_NEAR(0.3, c.x, 1e-15);
    EXPECT_NEAR(0.0, c.y, 1e-15);
    EXPECT_NEAR(0.0, c.z, 1e-15);
}

TEST(colorbox, WhatIsInsideStays)
{
    const vec3 c = glsl::clippedToBox(vec3(0.5, 0.1, -0.1), vec3(0.4, 0.0, 0.0), vec3(0.1, 0.1, 0.1));
    EXPECT_EQ(0.5, c.x);
    EXPECT_EQ(0.1, c.y);
    EXPECT_EQ(-0.1, c.z);
}

// On the line to the middle, so that its hue is kept.
TEST(colorbox, WhatIsOutsideComesToTheSurface)
{
    const vec3 middle(0.5, 0.1, 0.2), extent(0.1, 0.2, 0.05), off(0.3, -0.1, 0.2);
    const vec3 c = glsl::clippedToBox(middle + off, middle, extent);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(middle[k] + off[k] / 4.0, c[k], 1e-15);
}

}  // namespace colorbox_test
