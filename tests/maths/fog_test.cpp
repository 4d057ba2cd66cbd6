// SPDX-License-Identifier: MIT
// What fog leaves, against OpenGL's definition and at its limits.
#include <Maths.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fog_test
{

using glsl::fogTransmittance;

TEST(fog, IsThatOfTheFixedFunction)
{
    EXPECT_DOUBLE_EQ(0.75, fogTransmittance(glsl::FOG_LINEAR, 3.0, 0.0, 2.0, 6.0));
    EXPECT_DOUBLE_EQ(std::exp(-0.6), fogTransmittance(glsl::FOG_EXP, 3.0, 0.2, 0.0, 0.0));
    EXPECT_DOUBLE_EQ(std::exp(-0.36), fogTransmittance(glsl::FOG_EXP2, 3.0, 0.2, 0.0, 0.0));
}

TEST(fog, LeavesAShareAtTheExtremes)
{
    const double huge = std::numeric_limits<float>::max();
    for (const int kind : {glsl::FOG_LINEAR, glsl::FOG_EXP, glsl::FOG_EXP2})
        for (const double distance : {0.0, 1e-30, 1.0, huge})
            for (const double density : {-1.0, 0.0, 1.0, huge})
                for (const double end : {-huge, 0.0, 1.0, huge}) {
                    const double f = fogTransmittance(kind, distance, density, 0.0, end);
                    EXPECT_TRUE(f >= 0.0 && f <= 1.0) << kind << " " << distance << " " << density << " " << end;
                }
    EXPECT_EQ(1.0, fogTransmittance(glsl::FOG_LINEAR, 0.9, 0.0, 1.0, 1.0));  // a wall
    EXPECT_EQ(0.0, fogTransmittance(glsl::FOG_LINEAR, 1.1, 0.0, 1.0, 1.0));
    EXPECT_EQ(1.0, fogTransmittance(glsl::FOG_EXP, 1.0, 0.0, 0.0, 0.0));
    EXPECT_EQ(0.0, fogTransmittance(glsl::FOG_EXP2, huge, huge, 0.0, 0.0));
}

}  // namespace fog_test
