// SPDX-License-Identifier: MIT
// Closed forms of radiosity and of virtual point lights, against the numbers of systems.md and against sums.
#include <gtest/gtest.h>

#include <numeric>

#include "Maths.h"
#include "Oracles.h"

namespace OraclesTransport_test
{

using namespace testmaths;
using namespace testmaths::oracle;

namespace
{

using Row = std::vector<double>;

// B = E + diag(rho) F B by iteration, until rho^n is below the last digit.
Row iterate(const Row& e, const Row& rho, const std::vector<Row>& f)
{
    Row b = e;
    for (int pass = 0; pass < 400; ++pass) {
        Row next = e;
        for (size_t i = 0; i < e.size(); ++i)
            for (size_t j = 0; j < e.size(); ++j) next[i] += rho[i] * f[i][j] * b[j];
        b = next;
    }
    return b;
}

// E / M below a disk, of lights with the kernel h^2 / d^2 weight(d^2), which may bend where the radius is breakAt. For heights
// from .1 of a radius of 2 on, 50 points a part leave 4e-13, 100 rounding.
double disk(double radius, double height, const std::function<double(double)>& weight, double breakAt)
{
    double sum = 0.0;
    const double middle = std::clamp(breakAt, 0.0, radius);
    for (auto [low, high] : {std::pair(0.0, middle), std::pair(middle, radius)}) {
        const Gauss g = gauss(100, low, high);
        for (size_t i = 0; i < g.x.size(); ++i) {
            const double d2 = g.x[i] * g.x[i] + height * height;
            sum += g.w[i] * 2.0 * pi * g.x[i] * height * height / d2 * weight(d2);
        }
    }
    return sum;
}

}  // namespace

TEST(OraclesTransport, ParallelPlates)
{
    const auto [b1, b2] = parallelPlates(1.0, 0.3, 0.8, 0.4);
    const Row b = iterate({1.0, 0.3}, {0.8, 0.4}, {{0.0, 1.0}, {1.0, 0.0}});
    EXPECT_NEAR(b1, b[0], 1e-15);
    EXPECT_NEAR(b2, b[1], 1e-15);
    EXPECT_EQ(parallelPlates(1.0, 2.0, 0.0, 0.0), std::pair(1.0, 2.0));
    // Both alike are a closed box.
    EXPECT_NEAR(parallelPlates(1.0, 1.0, 0.7, 0.7).first, closedBox(1.0, 0.7), 1e-15);
}

TEST(OraclesTransport, ConcentricSpheres)
{
    for (double r1 : {0.2, 0.9}) {
        const auto [b1, b2] = concentricSpheres(r1, 1.0, 1.0, 0.2, 0.6, 0.7);
        const Row b = iterate({1.0, 0.2}, {0.6, 0.7}, {{0.0, 1.0}, {r1 * r1, 1.0 - r1 * r1}});
        EXPECT_NEAR(b1, b[0], 1e-14) << r1;
        EXPECT_NEAR(b2, b[1], 1e-14) << r1;
        // What is emitted is absorbed: (1 - rho) H, H = (B - E) / rho.
        const double absorbed = r1 * r1 * 0.4 * (b1 - 1.0) / 0.6 + 0.3 * (b2 - 0.2) / 0.7;
        EXPECT_NEAR(absorbed, r1 * r1 + 0.2, 1e-14) << r1;
    }
    // Close together they are plates; alone, the outer is a sphere.
    EXPECT_EQ(concentricSpheres(1.0, 1.0, 1.0, 0.3, 0.8, 0.4), parallelPlates(1.0, 0.3, 0.8, 0.4));
    EXPECT_NEAR(concentricSpheres(0.0, 1.0, 5.0, 0.3, 0.8, 0.4).second, closedBox(0.3, 0.4), 1e-15);
}

TEST(OraclesTransport, IntegratingSphere)
{
    const Row areas = {0.1, 0.25, 0.4, 0.25};
    const Row e = {3.0, 0.0, 0.5, 1.0};
    const Row b = iterate(e, Row(4, 0.8), std::vector<Row>(4, areas));
    const double mean = std::inner_product(areas.begin(), areas.end(), e.begin(), 0.0);
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(integratingSphere(e[i], mean, 0.8), b[i], 1e-14) << i;
    EXPECT_NEAR(integratingSphere(1.0, 1.0, 0.8), closedBox(1.0, 0.8), 1e-15);
    // Its kernel: cos cos' / (pi d^2) = 1 / (4 pi) between any two points of the unit sphere.
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const glsl::vec3 p = random.direction(), d = random.direction() - p;
        const double d2 = glsl::dot(d, d);
        const double kernel = -glsl::dot(d, p) * glsl::dot(d, p + d) / (pi * d2 * d2);
        EXPECT_NEAR(kernel, 1.0 / (4.0 * pi), 1e-14 / d2) << i;  // d cancels
    }
}

TEST(OraclesTransport, ClosedBox)
{
    const double parallel = parallelRectangles(1.0, 1.0, 1.0);
    const double perpendicular = perpendicularRectangles(1.0, 1.0, 1.0);
    std::vector<Row> f(6, Row(6, perpendicular));
    for (size_t i = 0; i < 6; ++i) {
        f[i][i] = 0.0;
        f[i][i ^ 1u] = parallel;
    }
    for (double b : iterate(Row(6, 2.0), Row(6, 0.75), f)) EXPECT_NEAR(b, closedBox(2.0, 0.75), 1e-13);
}

TEST(OraclesTransport, SphericalCavity)
{
    EXPECT_NEAR(sphericalCavity(0.5, 0.5 * pi), 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(sphericalCavity(0.8, 0.5 * pi), 2.0 / 3.0, 1e-15);
    // The opening as a wall that emits the sky's pi L = 1 and reflects nothing
    for (double angle : {0.3, 1.0, 2.8}) {
        const double f = 0.5 * (1.0 - std::cos(angle));
        const Row b = iterate({1.0, 0.0}, {0.0, 0.8}, {{f, 1.0 - f}, {f, 1.0 - f}});
        EXPECT_NEAR(sphericalCavity(0.8, angle), b[1], 1e-14) << angle;
    }
    EXPECT_EQ(sphericalCavity(0.8, 0.0), 0.0);
    EXPECT_NEAR(sphericalCavity(0.8, pi), 0.8, 1e-15);
}

TEST(OraclesTransport, MissingAfterBounces)
{
    const double rho[] = {0.5, 0.8, 0.9, 0.99};
    const double printed[] = {7.6e-6, 0.0225, 0.167, 0.84};
    const double bound[] = {0.05e-6, 0.00005, 0.0005, 0.005};
    const int passes[] = {6, 20, 43, 458};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(missingAfter(16, rho[i]), printed[i], bound[i]) << rho[i];
        EXPECT_LT(missingAfter(passes[i], rho[i]), 0.01) << rho[i];
        EXPECT_GE(missingAfter(passes[i] - 1, rho[i]), 0.01) << rho[i];
        double sum = 0.0;
        for (int k = 0; k <= 16; ++k) sum += std::pow(rho[i], k);
        EXPECT_NEAR(1.0 - sum / closedBox(1.0, rho[i]), missingAfter(16, rho[i]), 1e-14) << rho[i];
    }
}

TEST(OraclesTransport, ClampLoss)
{
    // 69 % lost below an infinite plane at h = .3 c, 94 % at .1 c
    EXPECT_NEAR(1.0 - clampedDisk(1e6, 0.3, 1.0), 0.69, 0.005);
    EXPECT_NEAR(1.0 - clampedDisk(1e6, 0.1, 1.0), 0.94, 0.005);
    for (auto [r, h, c] :
         {std::tuple(2.0, 0.3, 1.0), std::tuple(2.0, 0.1, 0.2), std::tuple(0.5, 0.3, 1.0), std::tuple(2.0, 1.0, 0.5)}) {
        const auto weight = [c = c](double d2) { return 1.0 / (pi * std::max(d2, c * c)); };
        const double sum = disk(r, h, weight, std::sqrt(std::max(c * c - h * h, 0.0)));
        EXPECT_NEAR(clampedDisk(r, h, c), sum, 1e-14) << r << ' ' << h << ' ' << c;
    }
    EXPECT_NEAR(clampedDisk(1.5, 0.7, 0.7), coaxialDisk(1.5, 0.7), 1e-15);
    EXPECT_EQ(clampedDisk(0.0, 0.5, 1.0), 0.0);
}

TEST(OraclesTransport, DiskKernel)
{
    // -4 % at h = 2 s, -13 % at h = s; never more than 1
    EXPECT_NEAR(diskKernel(1e8, 2.0, 1.0), 0.96, 0.005);
    EXPECT_NEAR(diskKernel(1e8, 1.0, 1.0), 0.87, 0.005);
    for (double h : {0.1, 0.5, 3.0})
        for (double area : {0.01, 1.0}) {
            const double sum = disk(
                2.0, h, [area](double d2) { return 1.0 / (pi * d2 + area); }, 0.0);
            EXPECT_NEAR(diskKernel(2.0, h, area), sum, 1e-14) << h << ' ' << area;
            EXPECT_LT(diskKernel(1e8, h, area), 1.0) << h;
        }
    // Small lights are points: less than a / h^2.
    EXPECT_NEAR(diskKernel(2.0, 1.0, 1e-9), coaxialDisk(2.0, 1.0), 1e-9);
    EXPECT_EQ(diskKernel(0.0, 1.0, 1.0), 0.0);
}

TEST(OraclesTransport, PointGrid)
{
    // Directly below a light, and between four; the extremes by symmetry.
    const auto range = [](double height) {
        return std::pair(pointGrid(height, 1.0, 0.5, 0.5), pointGrid(height, 1.0, 0.0, 0.0));
    };
    const auto [low, high] = range(1.0);
    EXPECT_LT(high - 1.0, 0.0275);
    EXPECT_GT(high - 1.0, 0.0265);
    EXPECT_GT(low, 1.0 - 0.0275);
    EXPECT_NEAR(range(0.5).first, 0.71, 0.005);
    EXPECT_NEAR(range(0.5).second, 1.62, 0.005);
    EXPECT_NEAR(range(0.25).first, 0.29, 0.005);
    EXPECT_NEAR(range(0.25).second, 5.2, 0.05);
    // At .01 the light above is nearly all: 1 / (pi h^2), and 6.0268 h^2 / pi of the others.
    EXPECT_NEAR(pointGrid(0.01, 1.0, 0.0, 0.0), 1e4 / pi, 0.001);
    EXPECT_NEAR(pointGrid(30.0, 1.0, 0.2, 0.3), 1.0, 1e-15);
}

TEST(OraclesTransport, PointGridBySum)
{
    for (auto [h, s, x, y] : {std::tuple(0.25, 1.0, 0.0, 0.0), std::tuple(0.8, 2.0, 0.3, 0.1), std::tuple(1.0, 1.0, 0.5, 0.5)}) {
        const int reach = 400;
        double sum = 0.0;
        for (int j = -reach; j <= reach; ++j)
            for (int i = -reach; i <= reach; ++i) {
                const double r2 = s * s * ((i - x) * (i - x) + (j - y) * (j - y));
                if (r2 > s * s * reach * reach) continue;
                sum += s * s * h * h / (pi * (r2 + h * h) * (r2 + h * h));
            }
        // Beyond the circle a plane: h^2 / (R^2 + h^2). The circle holds its area to 9 reach lights (Gauss), each of h^2 / (pi
        // reach^4 s^2).
        const double rest = h * h / (s * s * reach * reach + h * h);
        const double bound = 9.0 * h * h / (pi * s * s * std::pow(reach, 3.0));
        EXPECT_NEAR(pointGrid(h, s, x, y), sum + rest, bound) << h;
    }
}

TEST(OraclesTransport, StochasticCulling)
{
    const double delta = 0.7;
    for (double x : {0.0, 0.07, 0.35, 0.63, 0.7, 2.0}) {
        // Over all random numbers (k + 1/2) / n: probabilities that are multiples of 1 / n come out exactly.
        const int n = 1000;
        double first = 0.0, second = 0.0;
        for (int k = 0; k < n; ++k) {
            const double p = std::min(1.0, x / delta);
            const double estimate = (k + 0.5) / n < p ? x / p : 0.0;
            first += estimate / n;
            second += estimate * estimate / n;
        }
        EXPECT_NEAR(first, x, 1e-13) << x;
        EXPECT_NEAR(stochasticCulling(x, delta), second - first * first, 1e-13) << x;
        EXPECT_LE(stochasticCulling(x, delta), delta * delta / 4.0 + 1e-16) << x;
    }
    EXPECT_NEAR(stochasticCulling(0.35, delta), delta * delta / 4.0, 1e-16);
}

}  // namespace OraclesTransport_test
