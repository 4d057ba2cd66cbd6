// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "Maths.h"

namespace bulge_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

// A triangle with its corners on the unit sphere and the sphere's normals there, about a direction.
struct Facet {
    vec3 corners[3];
    vec3 normal;
    Facet(const vec3& about, double angle)
    {
        const glsl::mat3 frame = glsl::frameAround(about);
        for (int k = 0; k < 3; ++k) {
            const double turn = 2.0 * pi * k / 3.0 + 0.3;
            corners[k] = frame * vec3(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle));
        }
        normal = about;
    }
};

}  // namespace

TEST(bulge, IsTheHeightOfASphereAboveItsFacets)
{
    Random random(5);
    for (double angle : {0.05, 0.1, 0.17})
        for (int i = 0; i < 200; ++i) {
            const Facet f(random.direction(), angle);
            double a = random.uniform(0, 1), b = random.uniform(0, 1);
            if (a + b > 1.0) std::tie(a, b) = std::tuple(1.0 - a, 1.0 - b);
            const vec3 p = f.corners[0] * (1.0 - a - b) + f.corners[1] * a + f.corners[2] * b;
            const vec3 n = glsl::normalize(p);  // as interpolation has it, normalised
            const double truth =
                std::sqrt(1.0 - glsl::dot(p, p) + std::pow(glsl::dot(p, f.normal), 2.0)) - glsl::dot(p, f.normal);
            const double found = glsl::bulgeAbove(f.normal, p, n, f.corners[0], f.corners[0]);
            const double highest = 1.0 - std::cos(angle);
            if (glsl::length(n - f.corners[0]) < 0.011) continue;  // near the corner it fades
            // Of second order in the angle (measured: .71 of its square).
            EXPECT_NEAR(found, truth, angle * angle * highest + 1e-12) << angle;
        }
}

TEST(bulge, IsTheHeightOfALongCylinderAboveItsFacets)
{
    Random random(7);
    for (double half : {0.05, 0.17}) {  // of a facet's width; it is 40 long
        const vec3 a(std::sin(-half), 0, std::cos(half)), up(0, 0, 1);
        for (int i = 0; i < 100; ++i) {
            const double x = random.uniform(-0.7, 1.0) * std::sin(half);
            const vec3 p(x, random.uniform(0, 40), std::cos(half));
            const vec3 n = glsl::normalize(vec3(x, 0, std::cos(half)));
            const double truth = std::sqrt(1.0 - x * x) - std::cos(half);
            EXPECT_NEAR(glsl::bulgeAbove(up, p, n, a, a), truth, half * half * (1.0 - std::cos(half)) + 1e-12) << half;
        }
    }
}

TEST(bulge, IsNothingOnPlanesHollowsAndEdges)
{
    const vec3 up(0, 0, 1), p(0.2, 0.1, 0), corner(1, 0, 0);
    EXPECT_EQ(0.0, glsl::bulgeAbove(up, p, up, corner, up));
    const vec3 inward = glsl::normalize(vec3(-0.3, 0, 1));
    EXPECT_EQ(0.0, glsl::bulgeAbove(up, p, up, corner, inward)) << "hollow";
    const vec3 edge = glsl::normalize(vec3(1, 0, 1));
    EXPECT_EQ(0.0, glsl::bulgeAbove(up, p, up, corner, edge)) << "a box whose normals were smoothed";
    EXPECT_EQ(0.0, glsl::bulgeAbove(up, corner, edge, corner, edge)) << "at the corner itself";
    const vec3 outward = glsl::normalize(vec3(0.3, 0, 1));
    EXPECT_TRUE(std::isfinite(glsl::bulgeAbove(up, corner - vec3(1e-12, 0, 0), outward, corner, outward)));
}

TEST(bulge, CountsUnderLowSunsAlone)
{
    // Facets of the largest lean that counts in full, .18: one hides another under suns lower than the angle between the two.
    const double lean = 0.6 * 0.3;
    EXPECT_EQ(1.0, glsl::bulgeUnderSun(1.0, 0.0));
    EXPECT_EQ(1.0, glsl::bulgeUnderSun(1.0, 2.0 * lean - 1e-6));
    EXPECT_NEAR(0.5, glsl::bulgeUnderSun(1.0, 2.5 * lean), 1e-6);
    EXPECT_EQ(0.0, glsl::bulgeUnderSun(1.0, 3.0 * lean + 1e-6));
    EXPECT_EQ(1.0, glsl::bulgeUnderSun(1.0, -1.0)) << "below the plane, as at its edge";
}

}  // namespace bulge_test
