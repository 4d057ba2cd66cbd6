// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace sharedexponent_test
{

using namespace testmaths;
using glsl::vec3;

TEST(sharedexponent, KeepsNineBitsOfTheLargest)
{
    Random random(7);
    for (int i = 0; i < 10000; ++i) {
        const double size = std::exp2(-12.0 + 27.0 * random.square().x);
        const vec3 c = size * vec3(random.square().x, random.square().x, random.square().x);
        const double largest = std::max({c.x, c.y, c.z});
        const vec3 back = glsl::unpackSharedExponent(glsl::packSharedExponent(c));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(back[k], c[k], std::max(largest / 512.0, 1e-7)) << c.x << " " << c.y << " " << c.z;
    }
}

TEST(sharedexponent, KeepsItsEnds)
{
    EXPECT_EQ(vec3(0), glsl::unpackSharedExponent(glsl::packSharedExponent(vec3(0))));
    EXPECT_EQ(vec3(1, 0.5, 0.25), glsl::unpackSharedExponent(glsl::packSharedExponent(vec3(1, 0.5, 0.25))));
    EXPECT_EQ(vec3(65408, 0, 65408), glsl::unpackSharedExponent(glsl::packSharedExponent(vec3(1e9, -1, 65408))));
    EXPECT_EQ(vec3(1, 0, 0), glsl::unpackSharedExponent(glsl::packSharedExponent(vec3(0.9999, 0, 0))));
    EXPECT_EQ(vec3(0), glsl::unpackSharedExponent(glsl::packSharedExponent(vec3(1e-9))));
}

}  // namespace sharedexponent_test
