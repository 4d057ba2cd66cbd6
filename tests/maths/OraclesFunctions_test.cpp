// SPDX-License-Identifier: MIT
// Closed forms of lobes and bases, against the numbers of systems.md 1.7 and against quadrature.
#include <gtest/gtest.h>

#include <stdexcept>

#include "Maths.h"
#include "Oracles.h"

namespace OraclesFunctions_test
{

using namespace testmaths;
using namespace testmaths::oracle;
using glsl::vec3;

namespace
{

// The distribution of slopes, from which D = P22 / cos^4.
double ggx(const vec3& h, double alpha)
{
    const double slope2 = (h.x * h.x + h.y * h.y) / (h.z * h.z * alpha * alpha);
    return 1.0 / (pi * alpha * alpha * (1.0 + slope2) * (1.0 + slope2) * std::pow(h.z, 4.0));
}

double lambda(double cosine, double alpha)
{
    const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent * tangent) - 1.0);
}

}  // namespace

TEST(OraclesFunctions, CosineLobes)
{
    for (double n : {0.0, 1.0, 5.0, 60.0}) {
        const auto lobe = [n](const vec3& d) { return std::pow(d.z, n); };
        EXPECT_NEAR(cosineLobe(n), integrateBand(lobe, 0.0, 1.0), 1e-13) << n;  // polynomials: only rounding
        const double withCosine = integrateBand([&](const vec3& d) { return d.z * lobe(d); }, 0.0, 1.0);
        EXPECT_NEAR(cosineLobeWithCosine(n), withCosine, 1e-13) << n;
    }
}

TEST(OraclesFunctions, Ggx)
{
    for (double alpha : {0.001, 0.04, 0.3, 1.0}) {
        EXPECT_NEAR(ggxPeak(alpha) / ggx(vec3(0.0, 0.0, 1.0), alpha), 1.0, 1e-15) << alpha;
        EXPECT_NEAR(ggxAtWidth(alpha) / ggx(fromSlope(alpha, 0.3), alpha), 1.0, 1e-14) << alpha;
        const double c = 1.0 / std::sqrt(1.0 + alpha * alpha);
        EXPECT_NEAR(ggxAtWidth(alpha) / (ggxPeak(alpha) / (4.0 * std::pow(c, 4.0))), 1.0, 1e-14) << alpha;
        // The cosines cancel: rational in integratePeak's variable, its poles at a distance of .5: 400 points leave rounding.
        EXPECT_NEAR(integratePeak([alpha](const vec3& h) { return ggx(h, alpha) * h.z; }, alpha), 1.0, 1e-12) << alpha;
    }
}

TEST(OraclesFunctions, AlbedoOfTheRoughest)
{
    EXPECT_NEAR(roughestAlbedo(1.0), 0.307, 0.0005);
    EXPECT_NEAR(roughestAlbedo(1.0), 1.0 - std::log(2.0), 1e-16);
    EXPECT_EQ(roughestAlbedo(0.0), 1.0);
    for (double mu : {1.0, 0.7, 0.2}) {
        const vec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
        const double sum = integrateBand(
            [&](const vec3& l) {
                const double g = 1.0 / (1.0 + lambda(mu, 1.0) + lambda(l.z, 1.0));
                return ggx(glsl::normalize(l + v), 1.0) * g / (4.0 * mu);  // f cos
            },
            0.0, 1.0);
        // D is 1 / pi everywhere; what is left has its pole at -mu: 64 points leave rounding.
        EXPECT_NEAR(roughestAlbedo(mu), sum, 1e-12) << mu;
    }
}

TEST(OraclesFunctions, CosineBands)
{
    const double printed[] = {pi, 2.0 * pi / 3.0, pi / 4.0, 0.0, -pi / 24.0, 0.0, pi / 64.0, 0.0, -0.0245436926};
    const double coefficients[] = {0.886226925, 1.023326708, 0.495415912, 0.0, -0.110778366, 0.0, 0.049927135};
    for (int l = 0; l <= 8; ++l) EXPECT_NEAR(cosineBand(l), printed[l], l < 8 ? 1e-15 : 0.5e-10) << l;
    for (int l = 0; l <= 6; ++l) EXPECT_NEAR(cosineCoefficient(l), coefficients[l], 0.5001e-9) << l;
    for (int l = 0; l <= 20; ++l) {
        const auto zonal = [l](const vec3& d) { return d.z * std::legendre(unsigned(l), d.z); };
        EXPECT_NEAR(cosineBand(l), integrateBand(zonal, 0.0, 1.0), 1e-14) << l;  // polynomials: only rounding
    }
}

TEST(OraclesFunctions, ReconstructedCosine)
{
    struct Case {
        int bands;
        double peak, least, peakBound, leastBound;
    };
    for (const Case& c : {Case{2, 0.75, -0.25, 1e-15, 1e-12}, Case{3, 1.0625, -19.0 / 480.0, 1e-15, 1e-9},
                          Case{5, 0.969, -0.031, 0.0005, 0.0005}}) {
        double least = 1.0;
        for (int i = 0; i <= 20000; ++i) least = std::min(least, reconstructedCosine(c.bands, -1.0 + i / 10000.0));
        EXPECT_NEAR(reconstructedCosine(c.bands, 1.0), c.peak, c.peakBound) << c.bands;
        EXPECT_NEAR(least, c.least, c.leastBound) << c.bands;  // a parabola of curvature 2 at most, looked at every 1e-4
    }
    EXPECT_NEAR(reconstructedCosine(3, -8.0 / 15.0), -0.0396, 0.5e-4);
    EXPECT_NEAR(reconstructedCosine(3, 0.0), 3.0 / 32.0, 1e-15);  // the largest error
    // All bands together give the cosine: the remainder of N bands falls with N^-1.5.
    for (double c : {-0.7, 0.2, 0.9}) EXPECT_NEAR(reconstructedCosine(60, c), std::max(c, 0.0), std::pow(60.0, -1.5)) << c;
}

TEST(OraclesFunctions, SphericalGaussians)
{
    EXPECT_NEAR(sphericalGaussian(0.0), 4.0 * pi, 1e-14);
    EXPECT_NEAR(sphericalGaussian(1e-8), 4.0 * pi * (1.0 - 1e-8), 1e-14);  // the next term is 1e-16 of it
    EXPECT_NEAR(sphericalGaussianProduct(0.0, 0.0, 1.0), 4.0 * pi, 1e-14);
    EXPECT_NEAR(sphericalGaussian(1e4), 2.0 * pi / 1e4, 1e-18);
    for (double s : {0.1, 1.0, 20.0}) {
        const auto lobe = [s](const vec3& d) { return std::exp(s * (d.z - 1.0)); };
        EXPECT_NEAR(sphericalGaussian(s), integrateBand(lobe, -1.0, 1.0), 1e-13) << s;
        EXPECT_NEAR(sphericalGaussianProduct(s, 0.0, 2.0), sphericalGaussian(s), 1e-14) << s;
        for (double t : {0.3, 5.0})
            for (double angle : {0.0, 1.0, 3.1}) {
                const vec3 axis(std::sin(angle), 0.0, std::cos(angle));
                const auto both = [&](const vec3& d) { return lobe(d) * std::exp(t * (glsl::dot(d, axis) - 1.0)); };
                // Entire functions, of exponents below 25: 64 x 128 points leave rounding.
                EXPECT_NEAR(sphericalGaussianProduct(s, t, angle), integrateBand(both, -1.0, 1.0), 1e-13) << s << ' ' << t;
            }
    }
    // Opposite and equal: constant e^(-2 s), the limit without a lobe.
    EXPECT_NEAR(sphericalGaussianProduct(3.0, 3.0, pi), 4.0 * pi * std::exp(-6.0), 1e-15);
    // Where sinh(u) overflows
    EXPECT_NEAR(sphericalGaussianProduct(1000.0, 1000.0, 0.0), 2.0 * pi / 2000.0, 1e-15);
}

TEST(OraclesFunctions, Haar)
{
    Random random(17);
    for (int n : {1, 2, 8, 64}) {
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j) {
                double product = 0.0;
                for (int k = 0; k < n; ++k) product += haarFunction(i, k, n) * haarFunction(j, k, n);
                EXPECT_NEAR(product, i == j ? 1.0 : 0.0, 1e-15) << n << ' ' << i << ' ' << j;
            }
        std::vector<double> values;
        for (int i = 0; i < n; ++i) values.push_back(random.uniform(-1.0, 1.0));
        const std::vector<double> coefficients = haarCoefficients(values);
        const std::vector<double> back = haarValues(coefficients);
        double energy = 0.0, inBasis = 0.0;
        for (size_t i = 0; i < values.size(); ++i) {
            EXPECT_NEAR(back[i], values[i], 1e-15 * (1 + n)) << n;
            energy += values[i] * values[i];
            inBasis += coefficients[i] * coefficients[i];
        }
        EXPECT_NEAR(inBasis, energy, 1e-15 * (1 + n)) << n;  // Parseval
    }
    // Sums and differences of halves, as the transform is usually written
    const std::vector<double> four = haarCoefficients({9.0, 7.0, 3.0, 5.0});
    const double expected[] = {12.0, 4.0, std::sqrt(2.0), -std::sqrt(2.0)};
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(four[i], expected[i], 1e-14);
    EXPECT_THROW(haarCoefficients(std::vector<double>(6)), std::invalid_argument);
    EXPECT_THROW(haarValues({}), std::invalid_argument);
}

TEST(OraclesFunctions, CubeTexels)
{
    for (int size : {1, 2, 7, 512}) {
        double sum = 0.0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) sum += cubeTexelSolidAngle(x, y, size);
        // size^2 differences of numbers about 1, rounded to 1e-16 at random
        EXPECT_NEAR(6.0 * sum, 4.0 * pi, 4e-16 * (10 + 6 * size)) << size;
    }
    const Gauss g = gauss(12, 0.0, 0.25);  // texels of an 8 x 8 face; poles are 4 of their sizes away
    for (auto [x, y] : {std::pair(0, 0), std::pair(3, 4), std::pair(7, 2)}) {
        double sum = 0.0;
        for (size_t i = 0; i < g.x.size(); ++i)
            for (size_t j = 0; j < g.x.size(); ++j) {
                const double u = 0.25 * x - 1.0 + g.x[i], v = 0.25 * y - 1.0 + g.x[j];
                sum += g.w[i] * g.w[j] * std::pow(1.0 + u * u + v * v, -1.5);
            }
        EXPECT_NEAR(cubeTexelSolidAngle(x, y, 8), sum, 1e-14) << x;
    }
    // Centre to corner 3^(3/2), but for 1 / size
    EXPECT_NEAR(cubeTexelSolidAngle(256, 256, 512) / cubeTexelSolidAngle(0, 0, 512), std::pow(3.0, 1.5), 5.2 * 3.0 / 512.0);
}

}  // namespace OraclesFunctions_test
