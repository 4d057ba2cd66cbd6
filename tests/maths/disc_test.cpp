// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "EmitterPoses.h"
#include "Oracles.h"
#include "SinglePrecision.h"

namespace disc_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

const double radii[] = {1.0, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-5};  // of discs at distance 1

double formFactor(const ExactLight& l)
{
    return glsl::discFormFactor(l.center, l.u, l.v);
}

double inSingle(const SingleLight& l)
{
    return double(single::discFormFactor(l.center, l.u, l.v));
}

double areaOf(const ExactLight& l)
{
    return pi * glsl::length(glsl::cross(l.u, l.v));
}

ExactLight randomDisc(Random& random, double radius)
{
    ExactLight l = randomLight(random, radius);
    l.v *= radius / glsl::length(l.v);
    return l;
}

// Of the surface's point above the disc's plane.
double heightOf(const ExactLight& l)
{
    return -glsl::dot(l.center, glsl::normalize(glsl::cross(l.u, l.v)));
}

bool isCut(const ExactLight& l)
{
    return std::abs(l.center.z) < std::hypot(l.u.z, l.v.z);
}

// The kernel cos cos' / (pi d^2) times the area, integrated over chords along the horizon from where it cuts the disc, x = R cos
// t, to the top: smooth in t and along the chord.
double byQuadrature(const ExactLight& l)
{
    static const Gauss nodes = gauss(60, 0.0, 1.0);
    const double rise = std::hypot(l.u.z, l.v.z);
    const vec3 up = rise > 0.0 ? (l.u.z * l.u + l.v.z * l.v) / rise : l.u;
    const vec3 side = rise > 0.0 ? (l.u.z * l.v - l.v.z * l.u) / rise : l.v;
    const vec3 w = glsl::cross(l.u, l.v);
    const double end = rise > 0.0 ? std::acos(std::clamp(-l.center.z / rise, -1.0, 1.0)) : pi;
    double sum = 0.0;
    for (size_t i = 0; i < nodes.x.size(); ++i) {
        const double t = end * nodes.x[i], half = std::sin(t);
        for (size_t j = 0; j < nodes.x.size(); ++j) {
            const vec3 p = l.center + std::cos(t) * up + (2.0 * nodes.x[j] - 1.0) * half * side;
            const double d2 = glsl::dot(p, p);
            sum += end * nodes.w[i] * 2.0 * nodes.w[j] * half * half * std::max(p.z, 0.0) * -glsl::dot(p, w) / (d2 * d2);
        }
    }
    return sum / pi;
}

}  // namespace

TEST(disc, AgainstClosedForms)
{
    for (double h : {1e-3, 0.1, 1.0, 7.0, 1e4})
        for (double r : {1e-3, 0.1, 1.0, 3.0, 100.0}) {
            const double exact = oracle::coaxialDisk(r, h);
            EXPECT_NEAR(formFactor({vec3(0, 0, h), vec3(0, r, 0), vec3(r, 0, 0)}), exact, 1e-12 * exact) << r << " " << h;
        }
}

TEST(disc, AgainstQuadrature)
{
    Random random(1);
    int cut = 0;
    for (int i = 0; i < 600; ++i) {
        const double radius = i % 3 ? radii[size_t(i) % 8] : random.uniform(0.01, 1.5);
        ExactLight l = randomDisc(random, radius);
        if (i % 2) l.center.z = random.uniform(-radius, radius);
        if (heightOf(l) < 0.3) continue;
        const double exact = byQuadrature(l);
        EXPECT_NEAR(formFactor(l), exact, 1e-12 * exact + 1e-13 * areaOf(l)) << radius << " " << isCut(l);
        cut += isCut(l);
    }
    EXPECT_GT(cut, 100);
}

// Near and far, whole and cut: a polygon of many vertices.
TEST(disc, AgainstAPolygon)
{
    Random random(2);
    const int vertices = 2000;
    const double widen = std::sqrt(2.0 * pi / vertices / std::sin(2.0 * pi / vertices));  // the same area
    for (int i = 0; i < 300; ++i) {
        const double radius = std::pow(10.0, random.uniform(-4.0, 1.0));
        ExactLight l = randomDisc(random, radius);
        if (i % 2) l.center.z = random.uniform(-radius, radius);
        glsl::PolygonSum sum = glsl::polygonSum(l.center, radius * radius);
        for (int k = 0; k < vertices; ++k) {
            const double angle = 2.0 * pi * k / vertices;
            sum = glsl::withVertex(sum, widen * (std::cos(angle) * l.u + std::sin(angle) * l.v));
        }
        const bool isLit = glsl::isLitSide(l.center, l.u, l.v);
        EXPECT_NEAR(formFactor(l), isLit ? glsl::polygonFormFactor(sum) : 0.0, 1e-5 * std::min(areaOf(l), 1.0)) << radius;
    }
}

// area-lights.md 8: in float clear of the horizon.
TEST(disc, InSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(3);
    for (double radius : radii) {
        std::vector<double> errors;
        while (errors.size() < 4000) {
            const ExactLight l = randomDisc(random, radius);
            const WorldPose pose = throughWorld(random, l);
            if (isCut(pose.meant) || l.center.z < 0.1 || heightOf(l) < 0.1) continue;
            errors.push_back(std::abs(inSingle(pose.found) / formFactor(pose.meant) - 1.0));
        }
        EXPECT_LT(percentile(errors, 0.99), 1e-5) << radius;
        EXPECT_LT(percentile(errors, 1.0), 1e-4) << radius;
    }
}

TEST(disc, CutInSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(4);
    std::vector<double> errors;
    for (int i = 0; i < 100000; ++i) {
        const double radius = std::pow(10.0, random.uniform(-5.0, 0.5));
        ExactLight l = randomDisc(random, radius);
        l.center.z = random.uniform(-1.2 * radius, 1.2 * radius);
        const SingleLight s = rounded(l);
        const double largest = radius * radius / (radius * radius + glsl::dot(l.center, l.center));
        errors.push_back(std::abs(inSingle(s) - formFactor(exact(s))) / largest);
    }
    EXPECT_LT(percentile(errors, 0.99), 1e-5);
    EXPECT_LT(percentile(errors, 1.0), 2e-4);
}

TEST(disc, OnItsPlaneAndBehind)
{
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        ExactLight l = randomDisc(random, 0.5);
        EXPECT_EQ(formFactor({-l.center, l.u, l.v}), 0.0);
        l.center.z = -0.5 - random.uniform();
        EXPECT_EQ(formFactor(l), 0.0);
    }
    for (double x : {0.0, 0.3, 1.0, 1.7}) {
        EXPECT_EQ(formFactor({vec3(x, 0, 0), vec3(0, 1, 0), vec3(1, 0, 0)}), 0.0);
        EXPECT_EQ(formFactor({vec3(x, 0, 0.4), vec3(0, 0, 1), vec3(1, 0, 0)}), 0.0);
        EXPECT_EQ(inSingle({glm::vec3(x, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)}), 0.0);
    }
    // Just in front: all, or half at the rim, of what the surface sees; half of that before a vertical disc.
    for (double height : {1e-3, 1e-6, 1e-12})
        for (const auto& [x, share] : {std::pair(0.0, 1.0), {0.3, 1.0}, {1.0, 0.5}, {1.3, 0.0}}) {
            const ExactLight l = {vec3(x, 0, height), vec3(0, 1, 0), vec3(1, 0, 0)};
            const ExactLight wall = {vec3(height, x, 0), vec3(0, 0, 1), vec3(0, 1, 0)};
            EXPECT_NEAR(formFactor(l), share, 2.0 * height + 1e-12);
            EXPECT_NEAR(inSingle(rounded(l)), share, 2.0 * height + 1e-6);
            EXPECT_NEAR(formFactor(wall), 0.5 * share, 3.0 * height + 1e-10) << x << " " << height;
            EXPECT_NEAR(inSingle(rounded(wall)), 0.5 * share, 3.0 * height + 1e-5) << x << " " << height;
        }
}

TEST(disc, NoAreaSendsNothing)
{
    const vec3 z(0, 0, 1), x(1, 0, 0), none(0);
    for (const ExactLight& l : {ExactLight{z, x, none}, {z, none, none}, {none, none, none}, {none, x, -x}}) {
        EXPECT_EQ(formFactor(l), 0.0);
        EXPECT_EQ(inSingle(rounded(l)), 0.0);
    }
    EXPECT_EQ(glsl::sphereFormFactor(z, 0.0), 0.0);
}

TEST(disc, TurningTheWorldChangesNothing)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(6);
    for (double radius : {1.0, 0.1, 1e-2}) {
        const ExactLight l = {vec3(0.3, -0.2, 0.8), 0.5 * radius * vec3(0, 0.6, 0.8), 0.5 * radius * vec3(1, 0, 0)};
        const double exact = formFactor(l);
        for (int i = 0; i < 1000; ++i) EXPECT_NEAR(inSingle(throughWorld(random, l).found) / exact, 1.0, 1e-5);
    }
}

TEST(disc, SphereAgainstItsClosedForm)
{
    for (double angle : {1e-6, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.5})
        for (double zenith = 0.0; zenith <= pi; zenith += 0.01) {
            const vec3 center = 3.0 * vec3(std::sin(zenith), 0, std::cos(zenith));
            const double square = std::sin(angle) * std::sin(angle);
            const double exact = oracle::sphere(angle, zenith);
            const double found = glsl::sphereFormFactor(center, 3.0 * std::sin(angle));
            EXPECT_NEAR(found, exact, 1e-12 * square + (square < 1e-3 ? 1e-8 * square : 0.0)) << angle << " " << zenith;
            const double inSingle = single::sphereFormFactor(glm::vec3(center), float(3.0 * std::sin(angle)));
            EXPECT_NEAR(inSingle, exact, 2e-4 * square) << angle << " " << zenith;
        }
    // Inside, and at its surface
    EXPECT_EQ(glsl::sphereFormFactor(vec3(0.1, 0.2, 0.3), 1.0), 1.0);
    EXPECT_EQ(glsl::sphereFormFactor(vec3(0, 0, 1), 1.0), 1.0);
    EXPECT_EQ(glsl::sphereFormFactor(vec3(0.0), 1.0), 1.0);
}

}  // namespace disc_test
