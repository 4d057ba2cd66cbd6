// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

using namespace testmaths;
using glsl::vec3;

TEST(bilateral, EveryGroupOfTheCellWeighsTheSame)
{
    for (int cells = 1; cells <= 8; ++cells)
        for (int centre = 0; centre < 4; ++centre) {
            double weight[4] = {};
            for (int i = -2 * cells; i <= 2 * cells; ++i) weight[((centre + i) % 4 + 4) % 4] += glsl::cellWeight(i, 2 * cells);
            for (double w : weight) EXPECT_EQ(w, cells) << cells << " " << centre;
        }
}

TEST(bilateral, GeometryWeight)
{
    const vec3 p(1, 2, -5);
    const vec3 n = glsl::normalize(vec3(1, 1, 3));
    const glsl::mat3 frame = glsl::frameAround(n);
    EXPECT_NEAR(glsl::geometryWeight(p, n, n, p, n, 0.1), 1.0, 1e-14);
    // In the receiver's plane distance does not count.
    EXPECT_NEAR(glsl::geometryWeight(p, n, n, p + 100.0 * frame[0], n, 0.1), 1.0, 1e-12);
    // One and a half footprints off the plane, either side: 1/e
    for (double side : {0.15, -0.15}) EXPECT_NEAR(glsl::geometryWeight(p, n, n, p + side * n, n, 0.1), std::exp(-1.0), 1e-13);
    // Normals at 60 degrees: cos^32
    const vec3 tilted = 0.5 * n + std::sqrt(0.75) * frame[1];
    EXPECT_NEAR(glsl::geometryWeight(p, n, n, p, tilted, 0.1) / std::ldexp(1.0, -32), 1.0, 1e-12);
    EXPECT_EQ(glsl::geometryWeight(p, n, n, p, -n, 0.1), 0.0);
    // The plane is the facet's, whatever the normals.
    EXPECT_NEAR(glsl::geometryWeight(p, frame[0], n, p + 0.15 * frame[0], n, 0.1), std::exp(-1.0), 1e-13);
    EXPECT_NEAR(glsl::geometryWeight(p, frame[0], n, p + 100.0 * n, n, 0.1), 1.0, 1e-12);
}

TEST(bilateral, FallsWithDistanceAndAngle)
{
    const vec3 n(0, 0, 1);
    double before = 2.0;
    for (int i = 0; i <= 100; ++i) {
        const double w = glsl::geometryWeight(vec3(0), n, n, vec3(0.3, 0.2, 0.04 * i), n, 1.0);
        EXPECT_LT(w, before);
        before = w;
    }
    before = 2.0;
    for (int i = 0; i < 90; ++i) {
        const double t = i * pi / 180.0;
        const double w = glsl::geometryWeight(vec3(0), n, n, vec3(0), vec3(std::sin(t), 0, std::cos(t)), 1.0);
        EXPECT_LT(w, before);
        before = w;
    }
}
