// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace guide_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

struct Sphere {
    vec3 to;
    double radius;
};

// Small and far, close, touched from outside, from inside, from its centre.
const Sphere spheres[] = {
    {vec3(3, -2, 5), 0.01}, {vec3(0, 0, -1), 0.5}, {vec3(1, 0, 0), 0.9999}, {vec3(0.1, 0.2, 0), 1.0}, {vec3(0, 0, 0), 2.0}};

bool isInside(const Sphere& s, const vec3& d)
{
    const double along = glsl::dot(d, s.to);
    const double distance2 = glsl::dot(s.to, s.to) - along * along;
    return glsl::dot(s.to, s.to) < s.radius * s.radius || (along > 0.0 && distance2 <= s.radius * s.radius * (1.0 + 1e-9));
}

}  // namespace

TEST(guide, ItsConeHoldsTheSphere)
{
    for (const Sphere& s : spheres) {
        const double opening = glsl::guideOpening(s.to, s.radius);
        const double sine = std::min(s.radius / std::sqrt(glsl::dot(s.to, s.to)), 1.0);
        const bool inside = glsl::dot(s.to, s.to) < s.radius * s.radius;
        EXPECT_NEAR(opening, inside ? 2.0 : 1.0 - std::cos(std::asin(sine)), 1e-12);
    }
}

// Each lies in the cone, where the density is one over the cone's solid angle: as many in each of its parts.
TEST(guide, DirectionsFillTheConeEvenly)
{
    const int samples = 20000, rings = 12, sectors = 8;
    Random random(5);
    for (const Sphere& s : spheres) {
        const double opening = glsl::guideOpening(s.to, s.radius);
        const double length = std::sqrt(glsl::dot(s.to, s.to));
        const glsl::mat3 frame = glsl::frameAround(length > 0.0 ? s.to / length : vec3(0, 0, 1));
        std::vector<double> observed(rings * sectors), expected(rings * sectors, double(samples) / (rings * sectors));
        for (int i = 0; i < samples; ++i) {
            const vec3 d = glsl::guideDirection(s.to, s.radius, random.square());
            ASSERT_NEAR(glsl::dot(d, d), 1.0, 1e-9);
            ASSERT_TRUE(isInside(s, d));
            const vec3 local = glsl::transpose(frame) * d;
            const vec3 off = d - frame[2];
            const double ring = 0.5 * glsl::dot(off, off) / opening * rings;
            const double sector = (std::atan2(local.y, local.x) / (2.0 * pi) + 0.5) * sectors;
            observed[size_t(std::min(int(ring), rings - 1) * sectors + std::min(int(sector), sectors - 1))] += 1.0;
        }
        EXPECT_GT(chiSquaredTest(observed, expected), sidak(int(std::size(spheres))));
    }
}

TEST(guide, ItsDensityIsOverItsCone)
{
    Random random(6);
    for (const Sphere& s : spheres) {
        const double solidAngle = 2.0 * pi * glsl::guideOpening(s.to, s.radius);
        for (int i = 0; i < 1000; ++i) {
            const vec3 u = random.upper();
            for (const vec3& d : {u, -u}) {
                const double density = glsl::guideDensity(s.to, s.radius, d);
                EXPECT_NEAR(density, isInside(s, d) ? 1.0 / solidAngle : 0.0, 1e-9 / solidAngle);
            }
        }
    }
}

// A probe that sees a small disc which faces it: at another place before it, the light is that of the disc there.
TEST(guide, WeighsWhatThePlaceReceives)
{
    const double radiance = 7.0, area = 1e-4;
    for (double distance : {0.5, 1.0, 4.0})
        for (double degrees : {0.0, 40.0, 80.0}) {
            const vec3 to(0, 0, distance), toProbe(0, 0, -2.0);
            const vec3 n(std::sin(degrees * pi / 180.0), 0.0, std::cos(degrees * pi / 180.0));
            const double seen = radiance * area / (2.0 * 2.0) / (4.0 * pi);  // of the mean over the sphere
            const double truth = radiance * area * n.z / (distance * distance) / pi;
            EXPECT_NEAR(glsl::guideWeight(to, 0.0, n, seen, toProbe), truth, 1e-9 * truth);
        }
    EXPECT_EQ(0.0, glsl::guideWeight(vec3(0, 0, -1), 0.1, vec3(0, 0, 1), 1.0, vec3(1, 0, 0)));
    EXPECT_TRUE(std::isfinite(glsl::guideWeight(vec3(0, 0, 0), 0.0, vec3(0, 0, 1), 1.0, vec3(0, 0, 0))));
}

// Steps of a fifth of an octave: at most a tenth beside it.
TEST(guide, ANumberKeepsItsShare)
{
    for (int number : {0, 1, 511, 1023})
        for (double share = 1.0; share > 2.5e-4; share *= 0.97) {
            const glsl::uint code = glsl::packGuide(number, share);
            EXPECT_LT(code, 1u << 16);
            EXPECT_EQ(number, glsl::guideNumber(code));
            EXPECT_NEAR(std::log2(glsl::guideShare(code) / share), 0.0, 0.1 + 1e-12);
        }
    EXPECT_EQ(0.0, glsl::guideShare(glsl::packGuide(3, 0.0)));
    EXPECT_EQ(0.0, glsl::guideShare(glsl::packGuide(-1, 0.0)));
    EXPECT_EQ(0.0, glsl::guideShare(glsl::packGuide(1023, 1e-9)));
    EXPECT_EQ(1.0, glsl::guideShare(glsl::packGuide(3, 2.0)));
}

}  // namespace guide_test
