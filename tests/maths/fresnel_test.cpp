// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

using namespace testmaths;
using glsl::vec3;

TEST(fresnel, Limits)
{
    const vec3 f0(0.0, 0.04, 1.0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, 1.0), f0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, 0.0), vec3(1.0));
    // Cosines that rounding drives out of [0,1]
    EXPECT_EQ(glsl::fresnelSchlick(f0, 1.0 + 1e-7), f0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, -1e-7), vec3(1.0));
}

// From 2 % on all is reflected at grazing incidence; below, the reflectance is turned down at every angle.
TEST(fresnel, NothingReflectsNothing)
{
    for (double c : {0.0, 0.3, 1.0}) EXPECT_EQ(glsl::fresnelSchlick(vec3(0), c), vec3(0));
    EXPECT_EQ(1.0, glsl::fresnelSchlick(vec3(0.02), 0.0).x);
    EXPECT_NEAR(0.5, glsl::fresnelSchlick(vec3(0.01), 0.0).x, 1e-12);
    EXPECT_EQ(1.0, glsl::fresnelGrazing(vec3(1.0)));
}

TEST(fresnel, FallsWithTheCosine)
{
    for (int i = 0; i < 1000; ++i)
        EXPECT_GE(glsl::fresnelSchlick(vec3(0.04), i / 1000.0).x, glsl::fresnelSchlick(vec3(0.04), (i + 1) / 1000.0).x);
}

TEST(fresnel, HemisphericalMean)
{
    // 2 int F c dc = F0 + (1 - F0) / 21; a polynomial of degree 6, which 8 nodes integrate exactly
    const Gauss g = gauss(8, 0.0, 1.0);
    for (double f0 : {0.02, 0.04, 0.5, 1.0}) {
        double sum = 0.0;
        for (size_t i = 0; i < g.x.size(); ++i) sum += 2.0 * g.w[i] * g.x[i] * glsl::fresnelSchlick(vec3(f0), g.x[i]).y;
        EXPECT_NEAR(sum, f0 + (1.0 - f0) / 21.0, 1e-14);
    }
}
