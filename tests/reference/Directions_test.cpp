// SPDX-License-Identifier: MIT
// The reference's own angles are the library's.
#include <gtest/gtest.h>

#include <reference/Directions.h>

#include <random>

namespace Directions_test
{

using namespace osgEnvLight;

namespace
{

glm::dvec3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

}  // namespace

TEST(Directions, CircleAndAnglesAreTheLibrarys)
{
    for (int i = -4000; i <= 4000; ++i) {
        const double turn = i / 2000.0 + 1e-5;
        const glm::dvec2 c = onCircle(turn);
        EXPECT_NEAR(c.x, std::cos(2.0 * pi * turn), 2e-10) << turn;
        EXPECT_NEAR(c.y, std::sin(2.0 * pi * turn), 2e-10) << turn;
        for (double radius : {1e-300, 1.0, 1e300}) {
            const double x = radius * std::cos(2.0 * pi * turn), y = radius * std::sin(2.0 * pi * turn);
            EXPECT_NEAR(turnOf(y, x), std::atan2(y, x) / (2.0 * pi), 1e-10) << turn << ", " << radius;
        }
    }
    for (double x : {-1.0, -0.0, 0.0, 1.0})
        for (double y : {-1.0, 0.0, 1.0})
            if (x != 0.0 || y != 0.0) {
                EXPECT_NEAR(turnOf(y, x), std::atan2(y, x) / (2.0 * pi), 1e-10) << x << ", " << y;
            }
    EXPECT_NEAR(turnOf(0.0, 0.0), 0.0, 1e-10);
}

TEST(Directions, FramesAreOrthonormalAndRightHanded)
{
    std::mt19937 random(1);
    std::vector<glm::dvec3> normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, -0.0}};
    for (int i = 0; i < 1000; ++i) normals.push_back(randomDirection(random));
    for (const glm::dvec3& n : normals) {
        const glm::dmat3 f = frameAbout(n);
        EXPECT_EQ(n, f[2]);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) EXPECT_NEAR(glm::dot(f[i], f[j]), i == j ? 1.0 : 0.0, 1e-14);
        EXPECT_NEAR(glm::determinant(f), 1.0, 1e-14);
    }
}

}  // namespace Directions_test
