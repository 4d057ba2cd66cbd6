// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace frame_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

void expectFrame(const vec3& n)
{
    const glsl::mat3 m = glsl::frameAround(n);
    // Duff et al. 2017 state unit length and orthogonality to rounding; n itself is unit to 2e-16.
    const double tolerance = 2e-15;
    EXPECT_EQ(m[2], n);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(glsl::dot(m[i], m[j]), i == j ? 1.0 : 0.0, tolerance) << n.x << " " << n.y << " " << n.z;
    EXPECT_NEAR(glsl::dot(glsl::cross(m[0], m[1]), m[2]), 1.0, tolerance);
}

}  // namespace

TEST(frame, OrthonormalAndRightHanded)
{
    Random random(2);
    for (int i = 0; i < 10000; ++i) expectFrame(random.direction());
}

TEST(frame, PolesAndEquator)
{
    for (double z : {1.0, -1.0}) expectFrame(vec3(0, 0, z));
    for (double z : {0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17})
        for (vec3 n : {vec3(1, 0, z), vec3(-1, 0, z), vec3(0, 1, z), vec3(0.6, -0.8, z)}) expectFrame(n);
}

TEST(frame, CloseToTheSouthPole)
{
    // The sign makes 1 / (s + n.z) at most 1 in size: Frisvad's frame fails here.
    for (double x : {1e-4, 1e-8, 1e-12}) expectFrame(vec3(x, 0, -std::sqrt(1.0 - x * x)));
}

}  // namespace frame_test
