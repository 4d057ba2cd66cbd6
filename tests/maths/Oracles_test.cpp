// SPDX-License-Identifier: MIT
// Closed forms of light that arrives, against the numbers of systems.md 1.7 and against quadrature.
#include <gtest/gtest.h>

#include "Maths.h"
#include "Oracles.h"

namespace Oracles_test
{

using namespace testmaths;
using namespace testmaths::oracle;
using glsl::vec3;

namespace
{

const double degree = pi / 180.0;

// What a printed number of so many digits leaves open.
double digits(int n)
{
    return 0.5 * std::pow(10.0, -n) * 1.0001;
}

// Gauss-Legendre after x = low + (high - low) (1 - cos u) / 2, which removes the square roots at both ends.
double integrate(const std::function<double(double)>& f, double low, double high, int n = 64)
{
    const Gauss g = gauss(n, 0.0, pi);
    double sum = 0.0;
    for (size_t i = 0; i < g.x.size(); ++i)
        sum += g.w[i] * 0.5 * (high - low) * std::sin(g.x[i]) * f(low + (high - low) * 0.5 * (1.0 - std::cos(g.x[i])));
    return sum;
}

// E / (pi L) of a cap of that angular radius (90 degrees: a half sky): of each ring about the normal its part inside.
double capByRings(double radius, double zenith)
{
    const auto ring = [&](double theta) {
        const double c = (std::cos(radius) - std::cos(theta) * std::cos(zenith)) / (std::sin(theta) * std::sin(zenith));
        return 2.0 * std::acos(std::clamp(c, -1.0, 1.0)) * std::cos(theta) * std::sin(theta) / pi;
    };
    const double from = std::abs(zenith - radius);
    const double to = std::min({zenith + radius, 2.0 * pi - zenith - radius, 0.5 * pi});
    const double whole = zenith < radius ? std::sin(std::min(from, 0.5 * pi)) * std::sin(std::min(from, 0.5 * pi)) : 0.0;
    return whole + (from < to ? integrate(ring, from, to) : 0.0);
}

// cos cos' / (pi d^2) over a rectangle given by its corner and edges, by n x n Gauss points; light from behind is none.
double rectangleBySum(const vec3& corner, const vec3& u, const vec3& v, int n)
{
    const Gauss g = gauss(n, 0.0, 1.0);
    const vec3 normal = glsl::cross(u, v);
    double sum = 0.0;
    for (size_t i = 0; i < g.x.size(); ++i)
        for (size_t j = 0; j < g.x.size(); ++j) {
            const vec3 d = corner + u * g.x[i] + v * g.x[j];
            const double d2 = glsl::dot(d, d);
            sum += g.w[i] * g.w[j] * std::max(d.z, 0.0) * std::abs(glsl::dot(d, normal)) / (pi * d2 * d2);
        }
    return sum;
}

}  // namespace

TEST(Oracles, PowerSky)
{
    for (double k : {0.0, 1.0, 4.0, 16.0}) {
        const double sum = integrateBand([k](const vec3& d) { return std::pow(d.z, k + 1.0); }, 0.0, 1.0) / pi;
        EXPECT_NEAR(powerSky(k), sum, 1e-14) << k;  // a polynomial: only rounding
    }
    EXPECT_EQ(powerSky(0.0), 1.0);
}

TEST(Oracles, HalfSky)
{
    for (double tilt : {1.0, 30.0, 75.0, 90.0, 120.0, 179.0})
        EXPECT_NEAR(halfSky(tilt * degree), capByRings(0.5 * pi, tilt * degree), 1e-14) << tilt;  // 32 points leave 2e-16
    EXPECT_EQ(halfSky(0.0), 1.0);
    EXPECT_EQ(halfSky(pi), 0.0);
}

TEST(Oracles, CoaxialDisk)
{
    for (double h : {0.2, 1.0, 7.0}) {
        const double sum = integrate([h](double r) { return 2.0 * r * h * h / std::pow(r * r + h * h, 2.0); }, 0.0, 1.5);
        EXPECT_NEAR(coaxialDisk(1.5, h), sum, 1e-13) << h;
        // The cone that a sphere and a disk fill alike
        EXPECT_NEAR(coaxialDisk(1.5, h), sphere(std::atan2(1.5, h), 0.0), 1e-15) << h;
    }
    EXPECT_EQ(coaxialDisk(0.0, 1.0), 0.0);
    EXPECT_EQ(coaxialDisk(1.0, 0.0), 1.0);
}

TEST(Oracles, Sphere)
{
    EXPECT_NEAR(sphere(60.0 * degree, 90.0 * degree), 0.195501, digits(6));
    EXPECT_NEAR(sphere(30.0 * degree, 100.0 * degree), 0.011284, digits(6));
    for (double s = 1.0; s <= 90.0; s += 4.45)
        for (double w = 0.5; w < 180.0; w += 8.3)
            // 32 points leave 9e-14, 64 rounding.
            EXPECT_NEAR(sphere(s * degree, w * degree), capByRings(s * degree, w * degree), 1e-14) << s << ' ' << w;
}

TEST(Oracles, SphereAtItsLimits)
{
    for (double t = 0.0; t <= 180.0; t += 15.0)  // it fills a half space
        EXPECT_NEAR(sphere(0.5 * pi, t * degree), halfSky(t * degree), 1e-15) << t;
    EXPECT_EQ(sphere(0.0, 0.5 * pi), 0.0);
    EXPECT_EQ(sphere(0.0, 0.3), 0.0);
    EXPECT_EQ(sphere(0.2, pi), 0.0);
    EXPECT_EQ(sphere(0.5 * pi, 0.0), 1.0);
    // Continuous where it begins to cross, and where it has set: the formula's slope is below 1.
    for (double s : {0.01, 0.5, 1.2}) {
        EXPECT_NEAR(sphere(s, 0.5 * pi - s - 1e-9), sphere(s, 0.5 * pi - s + 1e-9), 2e-9) << s;
        EXPECT_NEAR(sphere(s, 0.5 * pi + s - 1e-9), 0.0, 1e-9) << s;
    }
}

TEST(Oracles, Rectangles)
{
    EXPECT_NEAR(rectangleCorner(1.0, 1.0, 1.0), 0.1385316060, digits(10));
    EXPECT_NEAR(centredRectangle(1.0, 1.0, 1.0), 0.2394564705, digits(10));
    EXPECT_NEAR(centredRectangle(2.0, 2.0, 1.0), 0.554126, digits(6));  // the top of a hemicube
    for (auto [a, b, h] : {std::tuple(1.0, 1.0, 1.0), std::tuple(0.3, 2.0, 0.9), std::tuple(0.01, 0.02, 5.0)})
        EXPECT_NEAR(rectangleCorner(a, b, h), rectangleBySum(vec3(0, 0, h), vec3(a, 0, 0), vec3(0, b, 0), 48), 1e-13) << a;
    EXPECT_EQ(rectangleCorner(0.0, 1.0, 1.0), 0.0);
    EXPECT_EQ(rectangleCorner(0.0, 0.0, 0.0), 0.0);
    EXPECT_NEAR(rectangleCorner(0.3, 2.0, 0.0), 0.25, 1e-15);
    EXPECT_NEAR(rectangleCorner(0.3, 2.0, 1e-7), 0.25, 1e-7);
    EXPECT_NEAR(rectangleCorner(1e9, 1e9, 1.0), 0.25, 1e-9);
}

TEST(Oracles, VerticalRectangle)
{
    EXPECT_NEAR(verticalRectangle(1.0, 1.0, 1.0), 0.1114683940, digits(10));
    EXPECT_NEAR(verticalRectangle(1.0, 1.0, 1.0), (std::atan(1.0) - std::atan(std::sqrt(0.5)) / std::sqrt(2.0)) / pi, 1e-16);
    for (auto [x, w, h] : {std::tuple(1.0, 1.0, 1.0), std::tuple(0.9, 0.4, 1.5), std::tuple(3.0, 0.01, 0.02)})
        EXPECT_NEAR(verticalRectangle(x, w, h), rectangleBySum(vec3(x, -w, 0), vec3(0, 2 * w, 0), vec3(0, 0, h), 48), 1e-13) << x;
    EXPECT_EQ(verticalRectangle(1.0, 0.0, 1.0), 0.0);
    EXPECT_EQ(verticalRectangle(1.0, 1.0, 0.0), 0.0);
    EXPECT_EQ(verticalRectangle(0.0, 1.0, 1.0), 0.5);
    // A hemicube is closed.
    EXPECT_NEAR(centredRectangle(2.0, 2.0, 1.0) + 4.0 * verticalRectangle(1.0, 1.0, 1.0), 1.0, 1e-15);
}

TEST(Oracles, UnitSquares)
{
    EXPECT_NEAR(parallelRectangles(1.0, 1.0, 1.0), 0.1998248957, digits(10));
    EXPECT_NEAR(perpendicularRectangles(1.0, 1.0, 1.0), 0.2000437761, digits(10));
    EXPECT_NEAR(parallelRectangles(1.0, 1.0, 1.0) + 4.0 * perpendicularRectangles(1.0, 1.0, 1.0), 1.0, 1e-15);
    // Any box is closed.
    for (auto [a, b, c] : {std::tuple(1.0, 2.0, 3.0), std::tuple(0.2, 5.0, 1.0), std::tuple(1.0, 1.0, 0.1)}) {
        const double sides = 2.0 * perpendicularRectangles(a, b, c) + 2.0 * perpendicularRectangles(b, a, c);
        EXPECT_NEAR(parallelRectangles(a, b, c) + sides, 1.0, 1e-13) << a;
    }
}

TEST(Oracles, RectanglesFromPoints)
{
    // The mean over one rectangle of a point's form factor to the other.
    const double a = 1.0, b = 0.7, d = 0.8;
    const auto mean = [=](const std::function<double(double, double)>& f) {
        return integrate([&](double x) { return integrate([&](double y) { return f(x, y); }, 0.0, b); }, 0.0, a) / (a * b);
    };
    const double parallel = mean([=](double x, double y) {
        return rectangleCorner(x, y, d) + rectangleCorner(a - x, y, d) + rectangleCorner(x, b - y, d) +
               rectangleCorner(a - x, b - y, d);
    });
    EXPECT_NEAR(parallelRectangles(a, b, d), parallel, 1e-14);
    // Halves of symmetric ones; their slope is infinite at the common edge: 64 points leave 4e-12, 128 2e-14.
    const double perpendicular =
        mean([=](double x, double y) { return 0.5 * (verticalRectangle(y, x, d) + verticalRectangle(y, a - x, d)); });
    EXPECT_NEAR(perpendicularRectangles(a, b, d), perpendicular, 1e-11);
    // Reciprocity
    EXPECT_NEAR(b * perpendicularRectangles(a, b, d), d * perpendicularRectangles(a, d, b), 1e-15);
}

TEST(Oracles, InfiniteWall)
{
    EXPECT_NEAR(wallOcclusion(0.1, 1.0), 0.4502, digits(4));
    EXPECT_NEAR(wallOcclusion(0.5, 1.0), 0.2764, digits(4));
    EXPECT_NEAR(wallOcclusion(1.0, 1.0), 0.1464, digits(4));
    for (auto [a, h] : {std::pair(0.1, 1.0), std::pair(0.5, 1.0), std::pair(1.0, 1.0), std::pair(2.0, 0.3)}) {
        EXPECT_NEAR(wallOcclusion(a, h), 0.5 * (1.0 - a / std::sqrt(a * a + h * h)), 1e-15) << a;
        // A wall of half width w lacks less than h^2 / w^2 of it.
        EXPECT_NEAR(wallOcclusion(a, h), verticalRectangle(a, 1e6, h), 1e-12) << a;
        // In polar coordinates: at azimuth p it reaches up to the zenith angle of cosine h cos p / sqrt(a^2 + h^2 cos^2 p).
        for (int k : {0, 1}) {
            const auto column = [&, a = a, h = h](double p) {
                const double c = h * std::cos(p) / std::hypot(a, h * std::cos(p));
                return std::pow(c, k + 2) / (k + 2) / pi;
            };
            const Gauss g = gauss(100, -0.5 * pi, 0.5 * pi);
            double sum = 0.0;
            for (size_t i = 0; i < g.x.size(); ++i) sum += g.w[i] * column(g.x[i]);
            // 50 points leave 3e-12, 100 rounding.
            EXPECT_NEAR(k == 0 ? wallOcclusion(a, h) : wallOcclusionOfCosineSky(a, h), sum, 1e-14) << a << ' ' << k;
        }
    }
}

TEST(Oracles, InfiniteWallAtItsLimits)
{
    EXPECT_EQ(wallOcclusion(1.0, 0.0), 0.0);
    EXPECT_EQ(wallOcclusionOfCosineSky(1.0, 0.0), 0.0);
    EXPECT_NEAR(wallOcclusion(0.0, 1.0), 0.5, 1e-16);
    EXPECT_NEAR(wallOcclusionOfCosineSky(0.0, 1.0), 0.5 * powerSky(1.0), 1e-15);
}

TEST(Oracles, InfinitePlaneEmitterAtTheCorner)
{
    EXPECT_NEAR(halfPlaneAtEdge(0.5 * pi), 0.5, 1e-16);
    EXPECT_NEAR(halfPlaneAtEdge(0.5 * pi), verticalRectangle(1e-9, 1e3, 1e3), 1e-6);
    // A tilted horizon is such a plane, and the sky the rest.
    for (double t : {0.0, 0.4, 1.3, 2.5, pi}) EXPECT_NEAR(halfPlaneAtEdge(t) + halfSky(t), 1.0, 1e-15);
}

}  // namespace Oracles_test
