// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <complex>

#include "Maths.h"

namespace fresnel_test
{

using namespace testmaths;
using glsl::vec3;

TEST(fresnel, Limits)
{
    const vec3 f0(0.0, 0.04, 1.0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, 1.0), f0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, 0.0), vec3(1.0));
    // Cosines that rounding drives out of [0,1]
    EXPECT_EQ(glsl::fresnelSchlick(f0, 1.0 + 1e-7), f0);
    EXPECT_EQ(glsl::fresnelSchlick(f0, -1e-7), vec3(1.0));
}

// From 2 % on all is reflected at grazing incidence; below, the reflectance is turned down at every angle.
TEST(fresnel, NothingReflectsNothing)
{
    for (double c : {0.0, 0.3, 1.0}) EXPECT_EQ(glsl::fresnelSchlick(vec3(0), c), vec3(0));
    EXPECT_EQ(1.0, glsl::fresnelSchlick(vec3(0.02), 0.0).x);
    EXPECT_NEAR(0.5, glsl::fresnelSchlick(vec3(0.01), 0.0).x, 1e-12);
    EXPECT_EQ(1.0, glsl::fresnelGrazing(vec3(1.0)));
}

TEST(fresnel, FallsWithTheCosine)
{
    for (int i = 0; i < 1000; ++i)
        EXPECT_GE(glsl::fresnelSchlick(vec3(0.04), i / 1000.0).x, glsl::fresnelSchlick(vec3(0.04), (i + 1) / 1000.0).x);
}

TEST(fresnel, HemisphericalMean)
{
    // 2 int F c dc = F0 + (1 - F0) / 21; a polynomial of degree 6, which 8 nodes integrate exactly
    const Gauss g = gauss(8, 0.0, 1.0);
    for (double f0 : {0.02, 0.04, 0.5, 1.0}) {
        double sum = 0.0;
        for (size_t i = 0; i < g.x.size(); ++i) sum += 2.0 * g.w[i] * g.x[i] * glsl::fresnelSchlick(vec3(f0), g.x[i]).y;
        EXPECT_NEAR(sum, f0 + (1.0 - f0) / 21.0, 1e-14);
    }
}

namespace
{

using Complex = std::complex<double>;

// By complex cosines of the refracted ray [Born, Wolf 1999, 1.5.2]: another form than the library's.
double byComplexCosines(double c, double eta, double kappa)
{
    const Complex n(eta, kappa);
    const Complex inside = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
    const Complex across = (c - n * inside) / (c + n * inside);
    const Complex along = (n * c - inside) / (n * c + inside);
    return 0.5 * (std::norm(across) + std::norm(along));
}

struct Metal {
    const char* name;
    double eta, kappa;
};

// Red of most, and the blue of gold and copper, whose edges are brightest beside their middles.
const Metal metals[] = {{"aluminium", 1.34, 7.47},    {"gold, red", 0.18, 3.42}, {"gold, blue", 1.37, 1.77},
                        {"copper, blue", 1.32, 2.29}, {"silver", 0.16, 3.9},     {"chromium", 3.1, 3.3},
                        {"iron", 2.9, 3.0},           {"titanium", 2.7, 3.8},    {"nickel", 2.0, 3.7},
                        {"platinum", 2.3, 4.2},       {"tungsten", 3.5, 2.7}};

// Most that a form errs by at any angle.
template <class Form>
double worst(const Metal& m, const Form& form)
{
    double most = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const double c = i / 1000.0;
        most = std::max(most, std::abs(form(c) - byComplexCosines(c, m.eta, m.kappa)));
    }
    return most;
}

}  // namespace

TEST(fresnel, ExactAsByComplexNumbers)
{
    for (const double eta : {0.2, 1.0, 1.33, 1.5, 2.42, 4.0})
        for (const double kappa : {0.0, 0.5, 3.0, 10.0})
            for (const double c : {1e-9, 0.01, 0.2, 0.5, 0.9, 1.0}) {
                if (eta < 1.0 && kappa == 0.0 && eta * eta < 1.0 - c * c) continue;  // both cosines are imaginary there
                EXPECT_NEAR(byComplexCosines(c, eta, kappa), glsl::fresnelExact(c, eta, kappa), 1e-12)
                    << eta << " " << kappa << " " << c;
            }
    EXPECT_NEAR(1.0, glsl::fresnelExact(0.3, 0.5, 0.0), 1e-12) << "total reflection";
}

TEST(fresnel, ExactInClosedForm)
{
    EXPECT_NEAR(0.04, glsl::fresnelExact(1.0, 1.5, 0.0), 1e-12);
    EXPECT_NEAR(1.0, glsl::fresnelExact(0.0, 1.5, 2.0), 1e-12);
    EXPECT_NEAR(0.0, glsl::fresnelExact(0.4, 1.0, 0.0), 1e-12) << "no surface";
    // Brewster's angle, tan = n: what is left is half of ((n^2 - 1) / (n^2 + 1))^2.
    const double n = 1.5, r = (n * n - 1.0) / (n * n + 1.0);
    EXPECT_NEAR(0.5 * r * r, glsl::fresnelExact(1.0 / std::sqrt(1.0 + n * n), n, 0.0), 1e-12);
}

// .023 at worst, tungsten .029; kept in 4 bits .035. Schlick's form errs by up to .2.
TEST(fresnel, EdgesOfMetalsAreNearTheExactOnes)
{
    double schlicks = 0.0;
    for (const Metal& m : metals) {
        const vec3 f0(glsl::fresnelExact(1.0, m.eta, m.kappa));
        const double edge = glsl::fresnelExact(glsl::EDGE_COSINE, m.eta, m.kappa) / glsl::fresnelSchlick(f0, glsl::EDGE_COSINE).x;
        const auto with = [&](const vec3& e) {
            const vec3 loss = glsl::edgeLoss(f0, e);
            return worst(m, [&](double c) { return (glsl::fresnelSchlick(f0, c) - loss * glsl::edgeShare(c)).x; });
        };
        EXPECT_LT(with(vec3(std::min(edge, 1.0))), 0.03) << m.name;
        EXPECT_LT(with(glsl::unpackEdge(glsl::packEdge(vec3(edge)))), 0.04) << m.name;
        schlicks = std::max(schlicks, worst(m, [&](double c) { return glsl::fresnelSchlick(f0, c).x; }));
    }
    EXPECT_GT(schlicks, 0.15);
}

TEST(fresnel, EdgesComeBackFromThirteenBits)
{
    for (int i = 0; i <= 15; ++i) {
        const vec3 edge(i / 15.0, (15 - i) / 15.0, 1.0);
        EXPECT_LT(glsl::packEdge(edge), 1u << 13);
        EXPECT_LT(glsl::length(edge - glsl::unpackEdge(glsl::packEdge(edge))), 1e-12);
    }
    EXPECT_EQ(vec3(1.0), glsl::unpackEdge(0u)) << "of what is no metal";
    EXPECT_EQ(vec3(1.0), glsl::unpackEdge(glsl::packEdge(vec3(7.0))));
    EXPECT_EQ(0.0, glsl::edgeLoss(vec3(0.5), vec3(1.0)).x);
}

}  // namespace fresnel_test
