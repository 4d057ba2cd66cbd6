// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace coat_test
{

using namespace testmaths;
using glsl::Bsdf;
using glsl::Coat;
using glsl::vec2;
using glsl::vec3;

namespace
{

Coat coatOf(double strength, double roughness)
{
    Coat c;
    c.strength = strength;
    c.roughness = roughness;
    return c;
}

double overHemisphere(const Integrand& f)
{
    return integrateBand(f, 0.0, 1.0, 400, 800);
}

}  // namespace

TEST(coat, ComesBackFromItsThirteenBits)
{
    for (double strength : {0.0, 0.2, 0.5, 1.0})
        for (double roughness : {0.0, 0.03, 0.5, 1.0}) {
            const glsl::uint bits = glsl::packCoat(coatOf(strength, roughness));
            EXPECT_LT(bits, 1u << 13);
            const Coat c = glsl::unpackCoat(bits);
            EXPECT_NEAR(strength, c.strength, 0.5 / 31 + 1e-12);
            EXPECT_NEAR(roughness, c.roughness, 0.5 / 255 + 1e-12);
        }
    const Coat most = glsl::unpackCoat(glsl::packCoat(coatOf(7.0, 2.0)));
    EXPECT_EQ(1.0, most.strength);
    EXPECT_EQ(1.0, most.roughness);
    const Coat least = glsl::unpackCoat(glsl::packCoat(coatOf(-1.0, -1.0)));
    EXPECT_EQ(0.0, least.strength);
    EXPECT_EQ(0.0, least.roughness);
}

TEST(coat, ReflectsWhatItSays)
{
    for (double roughness : {0.3, 0.7})
        for (double degrees : {0.0, 60.0, 80.0}) {
            const double t = degrees * pi / 180.0;
            const vec3 v(std::sin(t), 0.0, std::cos(t));
            const vec2 table = microfacetAlbedo(BRDF_COOK_TORRANCE, v, roughness, overHemisphere);
            const Bsdf b = glsl::coatBsdf(coatOf(0.7, roughness), table);
            const double reflected = overHemisphere([&](const vec3& l) { return glsl::bsdfLobe(b, v, l).x * l.z; });
            EXPECT_NEAR(b.reflected.x, reflected, 1e-5) << roughness << " " << degrees;
        }
}

// What a white surface below gets it sends back: together they reflect all light, whatever the angle, and no more.
TEST(coat, LosesNothingOverAWhiteSurface)
{
    for (double strength : {0.0, 0.4, 1.0})
        for (double metal : {0.0, 1.0})
            for (double a : {0.05, 0.3, 0.9}) {
                const Bsdf top = glsl::coatBsdf(coatOf(strength, 0.2), vec2(a, 0.4 - 0.4 * a));
                const Bsdf base = glsl::makeBsdf(BRDF_COOK_TORRANCE, vec3(metal > 0.0 ? 1.0 : 0.04), 0.5, vec2(a, 0.3 - 0.3 * a));
                const Bsdf below = glsl::belowCoat(base, top.reflected);
                EXPECT_NEAR(1.0, (top.reflected + below.reflected + below.body).x, 1e-12);
                EXPECT_NEAR(below.reflected.x / base.reflected.x, below.energy.x / base.energy.x, 1e-12);
            }
}

}  // namespace coat_test
