// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace strauss_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

// The lobe's reflectance as printed, of an opaque surface [Strauss 1990, eq. 8-17]: the part of Fresnel's rise, or the rest.
double byHand(double s, bool ofFresnel, double cosV, double cosL)
{
    const auto angle = [](double c) { return std::acos(c) / (0.5 * pi); };
    const auto F = [](double x) {
        const double k = 1.12;
        return (1.0 / std::pow(x - k, 2) - 1.0 / (k * k)) / (1.0 / std::pow(1.0 - k, 2) - 1.0 / (k * k));
    };
    const auto G = [](double x) {
        const double k = 1.01;
        return (1.0 / std::pow(1.0 - k, 2) - 1.0 / std::pow(x - k, 2)) / (1.0 / std::pow(1.0 - k, 2) - 1.0 / (k * k));
    };
    const double diffuse = 1.0 - std::pow(s, 3);
    const double normal = 1.0 - diffuse;
    const double j = F(angle(cosL)) * G(angle(cosL)) * G(angle(cosV));
    return std::min(1.0, normal + (normal + 0.1) * j) * (ofFresnel ? F(angle(cosL)) : 1.0 - F(angle(cosL)));
}

}  // namespace

TEST(strauss, TermsAtTheirEnds)
{
    EXPECT_NEAR(glsl::straussFresnel(0.0), 0.0, 1e-15);
    EXPECT_NEAR(glsl::straussFresnel(1.0), 1.0, 1e-13);
    EXPECT_NEAR(glsl::straussShadow(0.0), 1.0, 1e-13);
    EXPECT_NEAR(glsl::straussShadow(1.0), 0.0, 1e-9);
    for (double x = 0.0; x < 1.0; x += 0.01) {
        EXPECT_GE(glsl::straussFresnel(x + 0.01), glsl::straussFresnel(x));
        EXPECT_LE(glsl::straussShadow(x + 0.01), glsl::straussShadow(x));
    }
}

TEST(strauss, ReflectanceAsPrinted)
{
    Random random(22);
    for (int i = 0; i < 2000; ++i) {
        const double s = random.uniform(), cosV = random.uniform(), cosL = random.uniform();
        const vec2 r = glsl::straussReflectance(s, cosV, cosL);
        EXPECT_NEAR(r.x, byHand(s, false, cosV, cosL), 1e-12);
        EXPECT_NEAR(r.y, byHand(s, true, cosV, cosL), 1e-12);
        EXPECT_LE(r.x + r.y, 1.0 + 1e-15);
    }
}

TEST(strauss, SmoothnessAndExponentAreInverse)
{
    EXPECT_EQ(glsl::straussExponent(0.0), 3.0);
    EXPECT_NEAR(glsl::straussExponent(1.0), 1e6, 1.0);
    for (double s : {0.0, 0.1, 0.5, 0.9, 0.999}) EXPECT_NEAR(glsl::straussSmoothness(glsl::straussExponent(s)), s, 1e-12);
    EXPECT_EQ(glsl::straussSmoothness(0.0), 0.0);
}

// Body and lobe together: the lobe as makeBsdf takes it, in the mirror direction.
TEST(strauss, NeverReflectsMoreThanItGets)
{
    for (double s : {0.0, 0.3, 0.6, 0.9, 1.0})
        for (double metalness : {0.0, 0.5, 1.0})
            for (double cosV : {1.0, 0.7, 0.3, 0.1, 0.01}) {
                const double roughness = glsl::phongRoughness(glsl::straussExponent(s));
                const glsl::Bsdf b = glsl::makeBsdf(BRDF_STRAUSS, vec3(1), roughness, glsl::straussReflectance(s, cosV, cosV));
                const vec3 sum = b.reflected + b.body * glsl::straussDiffuse(s, metalness);
                EXPECT_LE(sum.x, 1.0 + 1e-9) << s << " " << metalness << " " << cosV;
                EXPECT_GE(sum.x, 0.0);
            }
}

}  // namespace strauss_test
