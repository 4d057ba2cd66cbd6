// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

#include <random>

namespace roughdiffuse_test
{

using namespace testmaths;
using glsl::RoughDiffuse;
using glsl::vec3;

namespace
{

const vec3 up(0, 0, 1);
const double roughnesses[] = {0.0, 0.05, 0.3, 0.7, 1.0};

vec3 at(double cosine)
{
    return vec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
}

double brdf(const RoughDiffuse& d, const vec3& v, const vec3& l)
{
    return glsl::roughDiffuseBrdf(d, v.z, l.z, glsl::dot(v, l)).x / pi;
}

double overHemisphere(const Integrand& f)
{
    return integrateBand(f, 0.0, 1.0, 400, 800);
}

}  // namespace

// Within 2e-4 of the quadrature, which has a kink where the light is on the view's side.
TEST(roughdiffuse, SendsItsAlbedo)
{
    for (const double roughness : roughnesses)
        for (const double rho : {0.1, 0.5, 1.0})
            for (const double cosine : {0.01, 0.2, 0.6, 1.0}) {
                const RoughDiffuse d = glsl::roughDiffuse(vec3(rho), roughness);
                const double sent = overHemisphere([&](const vec3& l) { return brdf(d, at(cosine), l) * l.z; });
                EXPECT_NEAR(sent, glsl::roughDiffuseAlbedo(d, cosine).x, 2e-4) << roughness << " " << rho << " " << cosine;
                EXPECT_LE(sent, 1.0 + 2e-4);
            }
}

TEST(roughdiffuse, WhiteLosesNothing)
{
    for (const double roughness : roughnesses)
        for (int i = 0; i <= 100; ++i)
            EXPECT_NEAR(1.0, glsl::roughDiffuseAlbedo(glsl::roughDiffuse(vec3(1.0), roughness), i / 100.0).x, 1e-12);
}

TEST(roughdiffuse, IsReciprocalAndNowhereNegative)
{
    const std::vector<vec3> directions = spiral(400);
    for (const double roughness : roughnesses) {
        const RoughDiffuse d = glsl::roughDiffuse(vec3(0.9, 0.5, 0.0), roughness);
        for (const vec3& v : directions)
            for (const vec3& l : directions) {
                if (v.z < 0.0 || l.z < 0.0) continue;
                const double f = brdf(d, v, l);
                ASSERT_GE(f, 0.0);
                ASSERT_NEAR(f, brdf(d, l, v), 1e-12 * f);
            }
    }
}

TEST(roughdiffuse, WithoutRoughnessIsLamberts)
{
    const RoughDiffuse d = glsl::roughDiffuse(vec3(0.7), 0.0);
    EXPECT_DOUBLE_EQ(0.7 / pi, brdf(d, at(0.3), at(0.8)));
    EXPECT_DOUBLE_EQ(0.7, glsl::roughDiffuseAlbedo(d, 0.1).x);
}

// The full moon is as bright at its rim as in its middle: light from behind the viewer, where Lambert's falls off with the
// cosine.
TEST(roughdiffuse, IsBrightTowardsTheRim)
{
    const RoughDiffuse moon = glsl::roughDiffuse(vec3(0.12), 1.0);
    EXPECT_LT(0.55, 0.3 * brdf(moon, at(0.3), at(0.3)) / brdf(moon, up, up));
    EXPECT_NEAR(
        0.3,
        0.3 * brdf(glsl::roughDiffuse(vec3(0.12), 0.0), at(0.3), at(0.3)) / brdf(glsl::roughDiffuse(vec3(0.12), 0.0), up, up),
        1e-12);
}

// Of a sky that bands 0 to 2 make up, the closed form is the integral.
TEST(roughdiffuse, SendsWhatItGetsOfASky)
{
    const double cosineBands[] = {1.0, 2.0 / 3.0, 0.25};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int turn = 0; turn < 12; ++turn) {
        std::vector<vec3> c(18, vec3(0.0)), sky(9);
        for (int i = 0; i < 9; ++i) {
            sky[size_t(i)] = i == 0 ? vec3(6.0) : vec3(number(random), number(random), number(random));
            c[size_t(i)] = cosineBands[i == 0 ? 0 : i < 4 ? 1 : 2] * sky[size_t(i)];
        }
        const vec3 n = glsl::normalize(vec3(number(random), number(random), number(random)));
        const glsl::mat3 frame = glsl::frameAround(n);
        const vec3 v = at(std::vector<double>{0.0, 0.05, 0.4, 0.7, 0.999, 1.0}[size_t(turn % 6)]);
        const RoughDiffuse d = glsl::roughDiffuse(vec3(0.8), roughnesses[turn % 5]);
        const vec3 sent = glsl::roughDiffuseOfSky(d, n, frame * v, glsl::shIrradiance9(c.data(), n), c.data());
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = overHemisphere([&](const vec3& l) {
                double radiance = 0.0;
                for (int i = 0; i < 9; ++i) radiance += sky[size_t(i)][channel] * glsl::shBasis18(i, frame * l);
                return radiance * brdf(d, v, l) * l.z;
            });
            EXPECT_NEAR(expected, sent[channel], 3e-4) << turn;  // by the kink, as above
        }
    }
}

TEST(roughdiffuse, IsFiniteAtTheEnds)
{
    const std::vector<vec3> c(18, vec3(1.0));
    for (const double roughness : {0.0, 1.0})
        for (const double albedo : {0.0, 1.0}) {
            const RoughDiffuse d = glsl::roughDiffuse(vec3(albedo), roughness);
            for (const vec3& v : {up, -up, vec3(1, 0, 0), vec3(1, 0, -1e-9)}) {
                const vec3 sent = glsl::roughDiffuseOfSky(d, up, v, vec3(1.0), std::vector<vec3>(c).data());
                EXPECT_TRUE(std::isfinite(sent.x) && sent.x >= 0.0);
                EXPECT_TRUE(std::isfinite(glsl::roughDiffuseBrdf(d, 0.0, 0.0, 1.0).x));
            }
        }
}

TEST(roughdiffuse, ComesBackFromItsBits)
{
    for (int i = 0; i <= 255; ++i) {
        const glsl::uint bits = glsl::packDiffuseRoughness(i / 255.0);
        EXPECT_LT(bits, 4096u) << "as edges of metals have it";
        EXPECT_DOUBLE_EQ(i / 255.0, glsl::unpackDiffuseRoughness(bits));
        EXPECT_DOUBLE_EQ(i / 255.0, glsl::unpackDiffuseRoughness(bits | 7u)) << "whatever is in the lowest bits";
    }
    EXPECT_EQ(0.0, glsl::unpackDiffuseRoughness(glsl::packEdge(vec3(0.5))));
    EXPECT_EQ(glsl::packDiffuseRoughness(1.0), glsl::packDiffuseRoughness(7.0));
    EXPECT_EQ(0u, glsl::packDiffuseRoughness(-1.0));
}

}  // namespace roughdiffuse_test
