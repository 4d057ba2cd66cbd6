// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace ggx_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

const double alphas[] = {1.0, 0.5, 0.1, 1e-2, 1e-3, 1e-4};

// Second formulations, in the tangent of the polar angle [Walter 2007, eq. 33; Heitz 2014, eq. 72].
double distribution(const vec3& h, double alpha)
{
    const double t2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    const double k = alpha * alpha + t2;
    return alpha * alpha / (pi * std::pow(h.z, 4) * k * k);
}

double lambda(double cosine, double alpha)
{
    const double t2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * t2) - 1.0);
}

double visibleNormals(const vec3& v, const vec3& h, double alpha)
{
    return distribution(h, alpha) * std::max(glsl::dot(v, h), 0.0) / ((1.0 + lambda(v.z, alpha)) * v.z);
}

vec3 eyeAt(double degrees)
{
    const double t = degrees * pi / 180.0;
    return vec3(std::sin(t), 0.0, std::cos(t));
}

// Share of incident energy that the lobe reflects for F = 1, by the directions l.
double albedo(const vec3& v, double alpha, int nz, int nphi)
{
    return integrateBand([&](const vec3& l) { return glsl::ggxBrdf(v, l, alpha) * l.z; }, 0.0, 1.0, nz, nphi);
}

}  // namespace

TEST(ggx, PeakAndHalfWidth)
{
    for (double alpha : alphas) {
        const double peak = 1.0 / (pi * alpha * alpha);
        EXPECT_NEAR(glsl::ggxD(vec3(0, 0, 1), alpha) / peak, 1.0, 1e-15);
        const vec3 h = fromSlope(alpha, 1.0);
        EXPECT_NEAR(glsl::ggxD(h, alpha) / (peak / (4.0 * std::pow(h.z, 4))), 1.0, 1e-13);
    }
}

TEST(ggx, DistributionHasUnitProjectedArea)
{
    // The integrand in t is rational of low degree: 400 nodes leave rounding only.
    for (double alpha : alphas)
        EXPECT_NEAR(integratePeak([&](const vec3& h) { return glsl::ggxD(h, alpha) * h.z; }, alpha), 1.0, 1e-12) << alpha;
}

TEST(ggx, DistributionInTangents)
{
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = std::pow(10.0, random.uniform(-4.0, 0.0));
        const vec3 h = fromSlope(alpha * std::exp(random.uniform(-5.0, 5.0)), random.uniform(0.0, 2.0 * pi));
        EXPECT_NEAR(glsl::ggxD(h, alpha) / distribution(h, alpha), 1.0, 1e-11);
    }
}

TEST(ggx, Furnace)
{
    // alpha = 1 seen from above: D = 1/pi and the albedo is int c / (1 + c) dc = 1 - ln 2. The integrand is smooth.
    EXPECT_NEAR(albedo(vec3(0, 0, 1), 1.0, 64, 8), 1.0 - std::log(2.0), 1e-12);
    // No lobe gives back more than it gets. 1e-6: quadrature where the lobe is narrow
    for (double alpha : {1.0, 0.7, 0.4, 0.2, 0.1})
        for (double degrees : {0.0, 30.0, 60.0, 80.0, 89.0}) {
            const double e = albedo(eyeAt(degrees), alpha, 400, 800);
            EXPECT_LE(e, 1.0 + 1e-6) << alpha << " " << degrees;
            EXPECT_GT(e, 0.3) << alpha << " " << degrees;
        }
}

TEST(ggx, AlbedoTendsToOneAsTheLobeNarrows)
{
    // The samples' weight is G2/G1: at alpha = 1e-3, 45 degrees, Lambda = 2.5e-7.
    const vec3 v = eyeAt(45.0);
    double sum = 0.0;
    for (int i = 0; i < 64; ++i) {
        const vec3 h =
            glsl::ggxVisibleNormalSample(v, 1e-3, vec2((i + 0.5) / 64.0, (i * 0.61803398875) - std::floor(i * 0.61803398875)));
        sum += glsl::ggxG2OverG1(v.z, 2.0 * glsl::dot(v, h) * h.z - v.z, 1e-3);
    }
    EXPECT_NEAR(sum / 64.0, 1.0, 1e-6);
}

TEST(ggx, MaskingFromLambda)
{
    Random random(4);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = std::pow(10.0, random.uniform(-3.0, 0.0));
        const double v = random.uniform(1e-2, 1.0);
        const double l = random.uniform(1e-2, 1.0);
        const double lv = lambda(v, alpha);
        const double ll = lambda(l, alpha);
        EXPECT_NEAR(glsl::ggxVisibility(v, l, alpha) * 4.0 * v * l * (1.0 + lv + ll), 1.0, 1e-12);
        EXPECT_NEAR(glsl::ggxG2OverG1(v, l, alpha) * (1.0 + lv + ll) / (1.0 + lv), 1.0, 1e-12);
    }
}

TEST(ggx, Reciprocal)
{
    Random random(5);
    for (int i = 0; i < 10000; ++i) {
        const vec3 v = random.upper();
        const vec3 l = random.upper();
        const double alpha = random.uniform(0.01, 1.0);
        const double f = glsl::ggxBrdf(v, l, alpha);
        EXPECT_NEAR(glsl::ggxBrdf(l, v, alpha), f, 1e-13 * f);
    }
    EXPECT_EQ(glsl::ggxBrdf(vec3(0, 0, 1), vec3(0, 0, -1), 0.5), 0.0);
    EXPECT_EQ(glsl::ggxBrdf(eyeAt(90.1), vec3(0, 0, 1), 0.5), 0.0);
}

TEST(ggx, ReflectionPdfIsThatOfVisibleNormals)
{
    Random random(6);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = std::pow(10.0, random.uniform(-3.0, 0.0));
        const vec3 v = random.upper();
        const vec3 h = fromSlope(alpha * std::exp(random.uniform(-3.0, 3.0)), random.uniform(0.0, 2.0 * pi));
        if (v.z < 1e-3 || glsl::dot(v, h) <= 1e-3) continue;
        const double exact = visibleNormals(v, h, alpha) / (4.0 * glsl::dot(v, h));
        EXPECT_NEAR(glsl::ggxReflectionPdf(v, h, alpha) / exact, 1.0, 1e-9);
    }
}

TEST(ggx, VisibleNormalsIntegrateToOne)
{
    // v.h is clamped, a kink that leaves the product rule an error of order (1/64)^2.
    for (double alpha : {1.0, 0.3, 0.01})
        for (double degrees : {0.0, 45.0, 80.0}) {
            const vec3 v = eyeAt(degrees);
            auto density = [&](const vec3& h) {
                const double c = glsl::dot(v, h);
                return c > 0.0 ? 4.0 * c * glsl::ggxReflectionPdf(v, h, alpha) : 0.0;
            };
            EXPECT_NEAR(integratePeak(density, alpha, 400, 256), 1.0, 2e-4) << alpha << " " << degrees;
        }
}

TEST(ggx, SamplesFollowTheVisibleNormals)
{
    const int samples = 400000;
    const int nt = 16;
    const int nphi = 32;
    const int sub = 6;
    Random random(7);
    for (double alpha : {1.0, 0.5, 0.1, 0.01})
        for (double degrees : {0.0, 45.0, 80.0, 89.9}) {
            const vec3 v = eyeAt(degrees);
            std::vector<double> observed(nt * nphi);
            std::vector<double> expected(nt * nphi);
            for (int i = 0; i < samples; ++i) {
                const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, random.square());
                const double s = std::hypot(h.x, h.y) / h.z / alpha;
                const double phi = std::atan2(h.y, h.x) / (2.0 * pi) + 0.5;
                const int x = std::min(int(s / (1.0 + s) * nt), nt - 1);
                observed[size_t(x * nphi + std::min(int(phi * nphi), nphi - 1))] += 1.0;
            }
            // The pdf integrated per bin in the same (t, phi), 12 x 12 Gauss nodes each
            const Gauss g = gauss(2 * sub, 0.0, 1.0);
            for (int x = 0; x < nt; ++x)
                for (int y = 0; y < nphi; ++y)
                    for (size_t i = 0; i < g.x.size(); ++i)
                        for (size_t j = 0; j < g.x.size(); ++j) {
                            const double t = (x + g.x[i]) / nt;
                            const double slope = alpha * t / (1.0 - t);
                            const double jacobian = alpha / ((1.0 - t) * (1.0 - t)) * slope * std::pow(1.0 + slope * slope, -1.5);
                            const vec3 h = fromSlope(slope, 2.0 * pi * ((y + g.x[j]) / nphi - 0.5));
                            expected[size_t(x * nphi + y)] +=
                                samples * g.w[i] * g.w[j] * jacobian * visibleNormals(v, h, alpha) * 2.0 * pi / nt / nphi;
                        }
            EXPECT_GT(chiSquaredTest(observed, expected), sidak(16)) << alpha << " " << degrees;
        }
}

TEST(ggx, GrazingSweepIsFinite)
{
    for (double alpha : {1.0, 0.1, 1e-2, 1e-4})
        for (double mu : {1.0, 1e-1, 1e-2, 1e-4, 1e-8, 1e-12})
            for (double x : {0.0, 0.25, 0.5, 1.0 - 1e-9})
                for (double y : {0.0, 0.5, 1.0 - 1e-9}) {
                    const vec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
                    const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, vec2(x, y));
                    EXPECT_NEAR(glsl::length(h), 1.0, 1e-14);
                    EXPECT_GT(h.z, 0.0);
                    const vec3 l = 2.0 * glsl::dot(v, h) * h - v;
                    EXPECT_TRUE(std::isfinite(glsl::ggxBrdf(v, l, alpha)));
                    EXPECT_TRUE(std::isfinite(glsl::ggxReflectionPdf(v, h, alpha)));
                    const double w = glsl::ggxG2OverG1(v.z, std::max(l.z, 0.0), alpha);
                    EXPECT_GE(w, 0.0);
                    EXPECT_LE(w, 1.0 + 1e-15);
                }
    EXPECT_TRUE(std::isfinite(glsl::ggxVisibility(0.0, 0.0, 0.5)));
}

TEST(ggx, WeightIsBrdfTimesCosineOverPdf)
{
    // The two estimators of one albedo agree sample by sample: f cos / pdf = G2 / G1.
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        const double alpha = random.uniform(0.05, 1.0);
        vec3 v = random.upper();
        if (v.z < 0.05) continue;
        const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, random.square());
        const vec3 l = 2.0 * glsl::dot(v, h) * h - v;
        if (l.z <= 1e-3) continue;
        const double w = glsl::ggxBrdf(v, l, alpha) * l.z / glsl::ggxReflectionPdf(v, h, alpha);
        EXPECT_NEAR(w / glsl::ggxG2OverG1(v.z, l.z, alpha), 1.0, 1e-8);
    }
}

}  // namespace ggx_test
