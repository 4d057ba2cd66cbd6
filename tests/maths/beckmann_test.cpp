// SPDX-License-Identifier: MIT
// Beckmann's and Blinn's distributions of normals and their masking.
#include <gtest/gtest.h>

#include "Maths.h"

namespace beckmann_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

const double alphas[] = {1.0, 0.5, 0.1, 1e-2, 1e-3};

vec3 at(double cosine)
{
    return vec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
}

double exponentOf(double alpha)
{
    return 2.0 / (alpha * alpha) - 2.0;
}

// Smith's shadowing function from the distribution itself: the area of the normals that face away, seen from v, over the area
// that faces v and stays [Heitz 2014, eq. 43]: the integral of <v,h> D over all normals is cos (1 + Lambda).
double facing(const std::function<double(const vec3&)>& distribution, const vec3& v, double alpha)
{
    return integratePeak([&](const vec3& h) { return std::max(glm::dot(v, h), 0.0) * distribution(h); }, alpha, 800, 800);
}

}  // namespace

TEST(beckmann, DistributionHasUnitProjectedArea)
{
    // 1e-9: 400 nodes on a Gaussian
    for (double alpha : alphas)
        EXPECT_NEAR(integratePeak([&](const vec3& h) { return glsl::beckmannD(h, alpha) * h.z; }, alpha), 1.0, 1e-9) << alpha;
}

TEST(beckmann, PeakAndSlopeOfOne)
{
    for (double alpha : alphas) {
        const double peak = 1.0 / (pi * alpha * alpha);
        EXPECT_NEAR(glsl::beckmannD(vec3(0, 0, 1), alpha) / peak, 1.0, 1e-15);
        // tan = alpha: exp(-1) / cos^4
        const vec3 h = fromSlope(alpha, 1.0);
        EXPECT_NEAR(glsl::beckmannD(h, alpha) / (peak * std::exp(-1.0) / std::pow(h.z, 4)), 1.0, 1e-12);
    }
}

TEST(beckmann, MaskingIsSmithsOfTheDistribution)
{
    // The root is cos (1 + 2 Lambda), so that cos (1 + Lambda) = (cos + root) / 2. The error function is good to 3e-7; the kink
    // of the clamped cosine leaves 1e-5.
    for (double alpha : {1.0, 0.5, 0.1})
        for (double cosine : {1.0, 0.7, 0.3, 0.05}) {
            const double area = facing([&](const vec3& h) { return glsl::beckmannD(h, alpha); }, at(cosine), alpha);
            EXPECT_NEAR(0.5 * (cosine + glsl::beckmannRoot(cosine, alpha)), area, 2e-5) << alpha << " " << cosine;
        }
}

TEST(blinn, MaskingIsSmithsOfTheDistribution)
{
    // .2 % as lib/blinn.glsl says, of which (cos + root) / 2 has half; the kink leaves 1e-5 here too.
    for (double n : {0.0, 0.5, 2.0, 10.0, 100.0})
        for (double cosine : {1.0, 0.99, 0.9, 0.7, 0.3, 0.05}) {
            const double area = facing([&](const vec3& h) { return glsl::blinnD(h, n); }, at(cosine), std::sqrt(2.0 / (n + 2.0)));
            EXPECT_NEAR(0.5 * (cosine + glsl::blinnRoot(cosine, n)), area, 0.001 * area + 2e-5) << n << " " << cosine;
        }
    for (double cosine : {1e-6, 0.1, 0.5, 1.0}) EXPECT_NEAR(glsl::blinnRoot(cosine, 0.0), glsl::ggxRoot(cosine, 1.0), 2e-3);
}

TEST(beckmann, CornersAreFinite)
{
    for (double alpha : {1e-4, 1e-2, 1.0})
        for (double cosine : {0.0, 1e-12, 1e-6, 0.5, 1.0}) {
            const double root = glsl::beckmannRoot(cosine, alpha);
            EXPECT_TRUE(std::isfinite(root) && root >= 0.0) << alpha << " " << cosine;
            EXPECT_TRUE(std::isfinite(glsl::beckmannD(at(cosine), alpha))) << alpha << " " << cosine;
            EXPECT_TRUE(std::isfinite(glsl::blinnD(at(cosine), exponentOf(alpha)))) << alpha << " " << cosine;
            const double blinn = glsl::blinnRoot(cosine, exponentOf(alpha));
            EXPECT_TRUE(std::isfinite(blinn) && blinn >= 0.0) << alpha << " " << cosine;
        }
    // At the horizon alpha / sqrt(pi), from Lambda = alpha tan / (2 sqrt(pi)).
    EXPECT_NEAR(glsl::beckmannRoot(0.0, 0.3), 0.3 / std::sqrt(pi), 1e-10);
    EXPECT_EQ(glsl::blinnD(vec3(0, 0, -1), 4.0), 0.0);
}

TEST(errorFunction, AgainstTheLibrary)
{
    for (double x = 0.0; x < 6.0; x += 0.01) EXPECT_NEAR(glsl::errorFunction(x), std::erf(x), 3.5e-7) << x;
    EXPECT_EQ(glsl::errorFunction(10.0), 1.0);
}

TEST(blinn, DistributionHasUnitProjectedArea)
{
    for (double alpha : alphas) {
        const double n = exponentOf(alpha);
        // 1e-8: the series of the logarithm stops at x^4, and is taken n times
        EXPECT_NEAR(integratePeak([&](const vec3& h) { return glsl::blinnD(h, n) * h.z; }, alpha), 1.0, 1e-8) << alpha;
    }
}

TEST(blinn, IsThePowerOfTheCosine)
{
    Random random(21);
    for (int i = 0; i < 10000; ++i) {
        const double n = std::pow(10.0, random.uniform(-2.0, 4.0));
        const vec3 h = fromSlope(std::sqrt(2.0 / (n + 2.0)) * random.uniform(0.0, 4.0), random.uniform(0.0, 2.0 * pi));
        const double exact = (n + 2.0) / (2.0 * pi) * std::pow(h.z, n);
        EXPECT_NEAR(glsl::blinnD(h, n), exact, 1e-9 * (n + 2.0)) << n;
    }
    // n = 0 spreads normals evenly, as GGX of alpha 1 does.
    EXPECT_NEAR(glsl::blinnD(at(0.3), 0.0), glsl::ggxD(at(0.3), 1.0), 1e-15);
}

}  // namespace beckmann_test
