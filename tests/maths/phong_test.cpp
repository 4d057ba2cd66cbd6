// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace phong_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

const double exponents[] = {0.0, 1.0, 5.0, 20.0, 200.0, 1e4, 1e6};
const vec3 up(0, 0, 1);

// The lobe has the width of a GGX of alpha = sqrt(2/(n+2)); integrated about the mirror direction.
double integrateLobe(const std::function<double(const vec3&)>& f, double exponent)
{
    return integratePeak(f, std::sqrt(2.0 / (exponent + 2.0)));
}

}  // namespace

TEST(phong, LobeIntegrals)
{
    // int cos^n = 2 pi/(n+1), int cos^(n+1) = 2 pi/(n+2). phongPower's series for log1p stops at x^4 and 1/3 has 11
    // digits: below 1e-9 of the integral.
    for (double n : exponents) {
        auto power = [&](const vec3& l) { return glsl::phongPower(up, l, n); };
        EXPECT_NEAR(integrateLobe(power, n) * (n + 1.0) / (2.0 * pi), 1.0, 1e-9) << n;
        EXPECT_NEAR(integrateLobe([&](const vec3& l) { return power(l) * l.z; }, n) * (n + 2.0) / (2.0 * pi), 1.0, 1e-9) << n;
    }
}

TEST(phong, ReflectsAllAtNormalIncidence)
{
    for (double n : exponents) {
        EXPECT_NEAR(integrateLobe([&](const vec3& l) { return glsl::phongBrdf(up, l, n) * l.z; }, n), 1.0, 1e-9) << n;
        EXPECT_NEAR(integrateLobe([&](const vec3& l) { return glsl::phongPdf(up, l, n); }, n), 1.0, 1e-9) << n;
    }
}

TEST(phong, NeverReflectsMoreThanItGets)
{
    // 1e-4: the horizon cuts the tilted lobe, a kink for the product rule
    for (double n : {0.0, 1.0, 5.0, 20.0, 200.0})
        for (double degrees : {0.0, 20.0, 45.0, 70.0, 89.0}) {
            const double t = degrees * pi / 180.0;
            const vec3 r(std::sin(t), 0.0, std::cos(t));
            const double e = integrateBand([&](const vec3& l) { return glsl::phongBrdf(r, l, n) * l.z; }, 0.0, 1.0, 200, 400);
            EXPECT_LE(e, 1.0 + 1e-4) << n << " " << degrees;
        }
}

TEST(phong, AlbedoIsTheIntegralOfTheLobe)
{
    // As its comment says; at n = 200 the quadrature's own error over the kink at the horizon.
    const std::pair<double, double> errors[] = {{0.0, 0.05}, {1.0, 0.03},   {2.0, 0.02},
                                                {4.0, 0.01}, {20.0, 0.005}, {200.0, 0.005}};
    for (const auto& [exponent, error] : errors)
        for (double degrees : {0.0, 20.0, 45.0, 70.0, 80.0, 89.0}) {
            const double n = exponent;  // a lambda can't capture the binding
            const double t = degrees * pi / 180.0;
            const vec3 r(std::sin(t), 0.0, std::cos(t));
            const double e = integrateBand([&](const vec3& l) { return glsl::phongBrdf(r, l, n) * l.z; }, 0.0, 1.0, 400, 800);
            EXPECT_NEAR(1.0, glsl::phongAlbedo(n, r.z) / e, error) << n << " " << degrees;
        }
    for (double n : exponents) {
        EXPECT_NEAR(1.0, glsl::phongAlbedo(n, 1.0), 1e-6) << n;
        EXPECT_LT(glsl::phongAlbedo(n, 0.0), 0.51) << n;
        EXPECT_EQ(glsl::phongAlbedo(n, 0.0), glsl::phongAlbedo(n, -0.1)) << n;
    }
    EXPECT_NEAR(0.3, glsl::phongAlbedo(1e6, 0.3), 1e-5) << "the cosine in which a mirror sends light on";
}

TEST(phong, PowerOfTheCosine)
{
    Random random(9);
    for (int i = 0; i < 10000; ++i) {
        const double n = std::pow(10.0, random.uniform(-2.0, 8.0));
        const vec3 l = fromSlope(std::sqrt(2.0 / (n + 2.0)) * random.uniform(0.0, 4.0), random.uniform(0.0, 2.0 * pi));
        const long double s2 = static_cast<long double>(l.x) * l.x + static_cast<long double>(l.y) * l.y;
        const auto exact = double(std::exp(0.5L * n * std::log1p(-s2)));
        // Peak 1; the truncated series and 1/3 of 11 digits leave n x^5/5 + 3e-12 n x^3 where n x < 16.
        EXPECT_NEAR(glsl::phongPower(up, l, n), exact, 1e-9) << n;
    }
    EXPECT_EQ(glsl::phongPower(up, vec3(1, 0, 0), 5.0), 0.0);
    EXPECT_EQ(glsl::phongPower(up, vec3(0, 0, -1), 5.0), 0.0);
    EXPECT_EQ(glsl::phongPower(up, up, 1e30), 1.0);
}

TEST(phong, Reciprocal)
{
    // f(v, l) depends on the angle between l and v's mirror image, which is that between v and l's.
    Random random(10);
    for (int i = 0; i < 1000; ++i) {
        const vec3 v = random.upper();
        const vec3 l = random.upper();
        const double f = glsl::phongBrdf(vec3(-v.x, -v.y, v.z), l, 30.0);
        EXPECT_NEAR(glsl::phongBrdf(vec3(-l.x, -l.y, l.z), v, 30.0), f, 1e-11 * (f + 1.0));
    }
}

TEST(phong, SamplesFollowThePdf)
{
    const int samples = 100000;
    const int nt = 24;
    const int nphi = 16;
    Random random(11);
    for (double n : {0.0, 1.0, 20.0, 500.0, 1e5}) {
        const double alpha = std::sqrt(2.0 / (n + 2.0));
        std::vector<double> observed(nt * nphi);
        std::vector<double> expected(nt * nphi);
        double meanCosine = 0.0;
        for (int i = 0; i < samples; ++i) {
            const vec3 l = glsl::phongSample(n, random.square());
            ASSERT_NEAR(glsl::length(l), 1.0, 1e-7);  // its sine is a series cut at x^4
            meanCosine += l.z / samples;
            const double s = std::hypot(l.x, l.y) / l.z / alpha;
            const double phi = std::atan2(l.y, l.x) / (2.0 * pi) + 0.5;
            observed[size_t(std::min(int(s / (1.0 + s) * nt), nt - 1) * nphi + std::min(int(phi * nphi), nphi - 1))] += 1.0;
        }
        const Gauss g = gauss(8, 0.0, 1.0);
        for (int x = 0; x < nt; ++x)
            for (int y = 0; y < nphi; ++y)
                for (size_t i = 0; i < g.x.size(); ++i) {
                    const double t = (x + g.x[i]) / nt;
                    const double slope = alpha * t / (1.0 - t);
                    const double jacobian = alpha / ((1.0 - t) * (1.0 - t)) * slope * std::pow(1.0 + slope * slope, -1.5);
                    const double pdf = glsl::phongPdf(up, fromSlope(slope, 0.0), n);
                    expected[size_t(x * nphi + y)] += samples * g.w[i] * jacobian * pdf * 2.0 * pi / nt / nphi;
                }
        EXPECT_GT(chiSquaredTest(observed, expected), sidak(5)) << n;
        // (n+1)/(n+2), within five standard deviations; those of the cosine are below 1/(n+2)
        EXPECT_NEAR(meanCosine, (n + 1.0) / (n + 2.0), 5.0 / (n + 2.0) / std::sqrt(double(samples))) << n;
    }
}

TEST(phong, SampleInvertsTheDistribution)
{
    // Share of the lobe above cos is 1 - cos^(n+1) = u.y
    for (double n : {0.0, 3.0, 100.0, 1e4})
        for (double y : {0.0, 0.1, 0.5, 0.9, 0.999})
            EXPECT_NEAR(1.0 - std::pow(glsl::phongSample(n, vec2(0.3, y)).z, n + 1.0), y, 1e-9);
}

TEST(phong, LogPdfIsThatOfTheDirection)
{
    for (double n : {0.0, 3.0, 100.0, 1e4, 1e6})
        for (double y : {0.0, 0.1, 0.5, 0.9, 0.999}) {
            const double logU = std::log(1.0 - y);
            const vec3 l = glsl::phongDirection(n, glsl::vec2(0.6, 0.8), logU);
            EXPECT_NEAR(std::exp(glsl::phongLogPdf(n, logU)) / glsl::phongPdf(up, l, n), 1.0, 1e-9) << n << " " << y;
        }
}

TEST(phong, CornersAreFinite)
{
    for (double n : {0.0, 1e-9, 1.0, 1e9, 1e30})
        for (double y : {0.0, 0.5, 1.0 - 1e-16, 1.0}) {
            const vec3 l = glsl::phongSample(n, vec2(0.0, y));
            EXPECT_NEAR(glsl::length(l), 1.0, 1e-7) << n << " " << y;
            EXPECT_TRUE(std::isfinite(glsl::phongPdf(up, l, n)));
        }
}

TEST(phong, RoughnessAndExponentAreInverse)
{
    EXPECT_EQ(glsl::phongRoughness(0.0), 1.0);
    EXPECT_EQ(glsl::phongExponent(1.0), 0.0);
    for (double n : {1e-3, 1.0, 20.0, 1e3, 1e6}) EXPECT_NEAR(glsl::phongExponent(glsl::phongRoughness(n)) / n, 1.0, 1e-11);
}

}  // namespace phong_test
