// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>

#include "EmitterPoses.h"
#include "Oracles.h"
#include "SinglePrecision.h"

namespace polygon_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

const double sizes[] = {1.0, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-5};  // of lights at distance 1

double formFactor(const ExactLight& l)
{
    return glsl::rectangleFormFactor(l.center, l.u, l.v);
}

double inSingle(const SingleLight& l)
{
    return double(single::rectangleFormFactor(l.center, l.u, l.v));
}

double areaOf(const ExactLight& l)
{
    return 4.0 * glsl::length(glsl::cross(l.u, l.v));
}

template <class Function>
double integrate(double low, double high, const Function& f)
{
    static const Gauss nodes = gauss(40, 0.0, 1.0);
    double sum = 0.0;
    for (size_t i = 0; i < nodes.x.size(); ++i) sum += nodes.w[i] * f(low + nodes.x[i] * (high - low));
    return sum * (high - low);
}

// The kernel cos cos' / (pi d^2) times the area, integrated over a and b in [-1,1]: smooth between the b where the horizon
// crosses, and between the a where that leaves an edge.
double byQuadrature(const ExactLight& l)
{
    const vec3 w = glsl::cross(l.u, l.v);
    std::vector<double> breaks = {-1.0, 1.0};
    for (double b : {-1.0, 1.0}) breaks.push_back(std::clamp(-(l.center.z + b * l.v.z) / l.u.z, -1.0, 1.0));
    std::sort(breaks.begin(), breaks.end());
    double sum = 0.0;
    for (size_t i = 0; i + 1 < breaks.size(); ++i)
        sum += integrate(breaks[i], breaks[i + 1], [&](double a) {
            const double rise = l.center.z + a * l.u.z;
            double low = -1.0, high = 1.0;
            (l.v.z > 0.0 ? low : high) = std::clamp(-rise / l.v.z, -1.0, 1.0);
            return integrate(low, high, [&](double b) {
                const vec3 p = l.center + a * l.u + b * l.v;
                const double d2 = glsl::dot(p, p);
                return std::max(p.z, 0.0) * std::max(-glsl::dot(p, w), 0.0) / (d2 * d2);
            });
        });
    return sum / pi;
}

double polygon(const vec3& center, const std::vector<vec3>& vertices)
{
    double square = 0.0;
    for (const vec3& v : vertices) square = std::max(square, glsl::dot(v, v));
    glsl::PolygonSum sum = glsl::polygonSum(center, square);
    for (const vec3& v : vertices) sum = glsl::withVertex(sum, v);
    return glsl::polygonFormFactor(sum);
}

std::vector<vec3> cornersOf(const ExactLight& l)
{
    return {l.u + l.v, l.v - l.u, -l.u - l.v, l.u - l.v};
}

// [0,a] x [0,b] above the surface, facing it.
ExactLight cornerAbove(double a, double b, double height)
{
    return {vec3(0.5 * a, 0.5 * b, height), vec3(0, 0.5 * b, 0), vec3(0.5 * a, 0, 0)};
}

}  // namespace

TEST(polygon, RectangleAgainstClosedForms)
{
    for (double h : {1e-3, 0.1, 1.0, 7.0, 1e3})
        for (double a : {1e-2, 1.0, 30.0})
            for (double b : {0.1, 1.0, 5.0}) {
                const double corner = oracle::rectangleCorner(a, b, h);
                EXPECT_NEAR(formFactor(cornerAbove(a, b, h)), corner, 1e-12 * corner + 1e-15) << a << " " << b << " " << h;
                const double centred = oracle::centredRectangle(a, b, h);
                const ExactLight above = {vec3(0, 0, h), vec3(0, 0.5 * b, 0), vec3(0.5 * a, 0, 0)};
                EXPECT_NEAR(formFactor(above), centred, 1e-12 * centred + 1e-15) << a << " " << b << " " << h;
                const ExactLight wall = {vec3(h, 0, 0), vec3(0, 0, a), vec3(0, b, 0)};
                const double vertical = oracle::verticalRectangle(h, b, a);
                EXPECT_NEAR(formFactor(wall), vertical, 1e-12 * vertical + 1e-15) << a << " " << b << " " << h;
            }
    // systems.md 1.7
    EXPECT_NEAR(formFactor(cornerAbove(1, 1, 1)), 0.1385316060, 1e-10);
    EXPECT_NEAR(formFactor({vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0)}), 0.1114683940, 1e-10);
}

TEST(polygon, RectangleAgainstQuadrature)
{
    Random random(1);
    int cut = 0;
    for (int i = 0; i < 300; ++i) {
        const double size = sizes[size_t(i) % 8];
        ExactLight l = randomLight(random, 0.5 * size);
        if (i % 2) l.center.z = random.uniform(-size, size);
        if (glsl::dot(l.center, glsl::cross(l.u, l.v)) > -0.2 * glsl::length(glsl::cross(l.u, l.v))) continue;
        const double exact = byQuadrature(l);
        // What doubles lose where the light is small and at the horizon.
        EXPECT_NEAR(formFactor(l), exact, 1e-12 * exact + 1e-14 * areaOf(l)) << size;
        EXPECT_NEAR(polygon(l.center, cornersOf(l)), exact, 1e-12 * exact + 1e-14 * areaOf(l)) << size;
        cut += std::abs(l.center.z) < std::abs(l.u.z) + std::abs(l.v.z);
    }
    EXPECT_GT(cut, 50);
}

// area-lights.md 8: in float clear of the horizon.
TEST(polygon, RectangleInSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(2);
    for (double size : sizes) {
        std::vector<double> errors;
        while (errors.size() < 4000) {
            const ExactLight l = randomLight(random, 0.5 * size);
            const WorldPose pose = throughWorld(random, l);
            const double facing = glsl::dot(l.center, glsl::cross(l.u, l.v)) / (0.25 * areaOf(l));
            if (l.center.z < 0.1 + 0.8 * size || facing > -0.1) continue;
            const double exact = formFactor(pose.meant);
            errors.push_back(std::abs(inSingle(pose.found) / exact - 1.0));
        }
        EXPECT_LT(percentile(errors, 0.99), 1e-5) << size;
        EXPECT_LT(percentile(errors, 1.0), 1e-4) << size;
    }
}

TEST(polygon, CutRectangleInSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(3);
    std::vector<double> errors;
    for (int i = 0; i < 100000; ++i) {
        const double size = std::pow(10.0, random.uniform(-5.0, 0.0));
        ExactLight l = randomLight(random, 0.5 * size);
        l.center.z = random.uniform(-0.7 * size, 0.7 * size);
        const SingleLight s = rounded(l);
        errors.push_back(std::abs(inSingle(s) - formFactor(exact(s))) / (size * size) * glsl::dot(l.center, l.center));
    }
    EXPECT_LT(percentile(errors, 0.99), 1e-6);
    EXPECT_LT(percentile(errors, 1.0), 2e-5);
}

// Closer than its size, across the horizon and not.
TEST(polygon, NearRectangleInSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(4);
    for (double height : {0.3, 0.1, 1e-2, 1e-3}) {
        double worst = 0.0;
        for (int i = 0; i < 20000; ++i) {
            ExactLight l = randomLight(random, 1.0);
            const double beside = random.uniform(-1.2, 1.2);
            l.center = beside * l.u + random.uniform(-1.2, 1.2) * l.v - height * glsl::normalize(glsl::cross(l.u, l.v));
            const SingleLight s = rounded(l);
            worst = std::max(worst, std::abs(inSingle(s) - formFactor(exact(s))));
        }
        EXPECT_LT(worst, 1e-4) << height;
    }
}

TEST(polygon, OnItsPlaneAndBehind)
{
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        ExactLight l = randomLight(random, 0.5);
        l.center = -l.center;
        EXPECT_EQ(formFactor(l), 0.0);
        EXPECT_LT(polygon(l.center, cornersOf(l)), 1e-15);
        // Below the horizon
        l.center = vec3(l.center.x, l.center.y, -random.uniform(0.0, 3.0) - std::abs(l.u.z) - std::abs(l.v.z));
        EXPECT_EQ(formFactor(l), 0.0);
        EXPECT_EQ(polygon(l.center, cornersOf(l)), 0.0);
    }
    for (double x : {0.0, 0.3, 1.0, 1.7}) {
        EXPECT_EQ(formFactor({vec3(x, 0, 0), vec3(0, 1, 0), vec3(1, 0, 0)}), 0.0);
        EXPECT_EQ(formFactor({vec3(x, 0, 0.4), vec3(0, 0, 1), vec3(1, 0, 0)}), 0.0);
        EXPECT_EQ(inSingle({glm::vec3(x, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)}), 0.0);
    }
    // Just in front: all, half or a quarter of what the surface sees.
    for (double height : {1e-3, 1e-6, 1e-12, 1e-20})
        for (const auto& [x, y, share] :
             {std::array{0.0, 0.0, 1.0}, {0.3, -0.2, 1.0}, {1.0, 0.0, 0.5}, {1.0, -1.0, 0.25}, {1.3, 0.0, 0.0}}) {
            const ExactLight l = {vec3(x, y, height), vec3(0, 1, 0), vec3(1, 0, 0)};
            EXPECT_NEAR(formFactor(l), share, 2.0 * height + 1e-12);
            EXPECT_NEAR(inSingle(rounded(l)), share, 2.0 * height + 1e-6);
            EXPECT_NEAR(polygon(l.center, cornersOf(l)), share, 2.0 * height + 1e-12);
        }
}

TEST(polygon, NoAreaSendsNothing)
{
    const vec3 z(0, 0, 1), x(1, 0, 0), none(0);
    for (const ExactLight& l : {ExactLight{z, x, none}, {z, none, none}, {z, x, x}, {none, none, none}, {none, x, -x}}) {
        EXPECT_EQ(formFactor(l), 0.0);
        EXPECT_EQ(inSingle(rounded(l)), 0.0);
        EXPECT_LT(polygon(l.center, cornersOf(l)), 1e-15);
    }
    EXPECT_EQ(polygon(z, {}), 0.0);
    EXPECT_EQ(polygon(z, {x}), 0.0);
    EXPECT_LT(polygon(z, {x, -x}), 1e-15);
}

TEST(polygon, PartsAddUp)
{
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        const ExactLight l = randomLight(random, 0.5 * sizes[size_t(i) % 8]);
        const double cut = random.uniform(-1.0, 1.0);
        const ExactLight left = {l.center + 0.5 * (cut - 1.0) * l.u, 0.5 * (cut + 1.0) * l.u, l.v};
        const ExactLight right = {l.center + 0.5 * (cut + 1.0) * l.u, 0.5 * (1.0 - cut) * l.u, l.v};
        const double whole = formFactor(l);
        EXPECT_NEAR(formFactor(left) + formFactor(right), whole, 1e-11 * areaOf(l));
        EXPECT_NEAR(inSingle(rounded(left)) + inSingle(rounded(right)), whole, 1e-5 * areaOf(l));
    }
}

// One pose in a world that is turned many times: the pose's floats differ, what the light sends does not.
TEST(polygon, TurningTheWorldChangesNothing)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(7);
    for (double size : {1.0, 0.1, 1e-2}) {
        const ExactLight l = {vec3(0.3, -0.2, 0.8), 0.5 * size * vec3(0, 0.6, 0.8), 0.5 * size * vec3(1, 0, 0)};
        const double exact = formFactor(l);
        // 1e-6 of the world's coordinates, of ten times the distance, is what the floats themselves move the light by.
        for (int i = 0; i < 1000; ++i) EXPECT_NEAR(inSingle(throughWorld(random, l).found) / exact, 1.0, 1e-5);
    }
}

TEST(polygon, ConcaveAgainstItsParts)
{
    // An L: three quarters of a parallelogram; and a triangle, half of one.
    Random random(8);
    int cut = 0;
    for (int i = 0; i < 4000; ++i) {
        const double size = sizes[size_t(i) % 8];
        ExactLight l = randomLight(random, 0.5 * size);
        if (i % 2) l.center.z = random.uniform(-size, size);
        if (!glsl::isLitSide(l.center, l.u, l.v)) continue;
        const vec3 none(0);
        const double whole = formFactor(l), scale = 1e-13 * areaOf(l);
        const double quarter = formFactor({l.center + 0.5 * (l.u + l.v), 0.5 * l.u, 0.5 * l.v});
        EXPECT_NEAR(polygon(l.center, {none, l.v, l.v - l.u, -l.u - l.v, l.u - l.v, l.u}), whole - quarter, 20.0 * scale);
        EXPECT_NEAR(polygon(l.center, {l.u + l.v, l.v - l.u, -l.u - l.v}) + polygon(l.center, {-l.u - l.v, l.u - l.v, l.u + l.v}),
                    whole, 20.0 * scale);
        cut += std::abs(l.center.z) < std::abs(l.u.z) + std::abs(l.v.z);
    }
    EXPECT_GT(cut, 1000);
}

// A star whose points and hollows the horizon cuts many times, as the signed sum of triangles about its centre.
TEST(polygon, StarAcrossTheHorizon)
{
    Random random(9);
    for (int i = 0; i < 500; ++i) {
        ExactLight l = randomLight(random, 0.3);
        l.center.z = random.uniform(-0.3, 0.3);
        if (!glsl::isLitSide(l.center, l.u, l.v)) continue;
        std::vector<vec3> star;
        for (int k = 0; k < glsl::MOST_POLYGON_VERTICES; ++k) {
            const double angle = 2.0 * pi * k / glsl::MOST_POLYGON_VERTICES;
            star.push_back(random.uniform(0.2, 1.0) * (std::cos(angle) * l.u + std::sin(angle) * l.v));
        }
        double sum = 0.0;
        for (size_t k = 0; k < star.size(); ++k) sum += polygon(l.center, {vec3(0), star[k], star[(k + 1) % star.size()]});
        EXPECT_NEAR(polygon(l.center, star), sum, 1e-12);
        std::vector<glm::vec3> single(star.begin(), star.end());
        const vec3 center(glm::vec3(l.center));
        EXPECT_NEAR(single::polygonFormFactor(glm::vec3(center), 0.2f, single), polygon(center, star), 1e-6);
    }
}

}  // namespace polygon_test
