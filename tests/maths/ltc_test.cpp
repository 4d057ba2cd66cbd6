// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "surface/LtcTable.h"

#include "EmitterPoses.h"
#include "LtcFit.h"
#include "SinglePrecision.h"

namespace ltc_test
{

using namespace testmaths;
using glsl::Ltc;
using glsl::vec3;
using glsl::vec4;

namespace
{

const double degree = pi / 180.0;

Ltc lobeOf(double roughness, double degrees)
{
    const osg::ref_ptr<osg::Image> image = osgEnvLight::ltcTableImage();
    const glsl::sampler2D table = {reinterpret_cast<const float*>(image->data()), image->s(), image->t()};
    return glsl::ltcOf(table, roughness, std::cos(degrees * degree));
}

vec3 viewAt(double degrees)
{
    return vec3(std::sin(degrees * degree), 0.0, std::cos(degrees * degree));
}

// The share of GGX's lobe whose directions are in a set, by its visible normals.
template <class Set>
double shareOfLobe(double roughness, double degrees, int side, const Set& contains)
{
    const double alpha = roughness * roughness;
    const vec3 v = viewAt(degrees);
    double inside = 0.0, all = 0.0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, glsl::vec2((i + 0.5) / side, (j + 0.5) / side));
            const vec3 l = 2.0 * glsl::dot(v, h) * h - v;
            if (l.z <= 0.0) continue;
            const double weight = glsl::ggxG2OverG1(v.z, l.z, alpha);
            all += weight;
            if (contains(l)) inside += weight;
        }
    return inside / all;
}

double shareOfLobe(double roughness, double degrees, const ExactLight& l)
{
    const vec3 w = glsl::cross(l.u, l.v);
    return shareOfLobe(roughness, degrees, 120, [&](const vec3& d) {
        const double along = glsl::dot(d, w);
        if (along >= 0.0) return false;
        const vec3 p = d * (glsl::dot(l.center, w) / along) - l.center;
        return std::abs(glsl::dot(p, l.u)) <= glsl::dot(l.u, l.u) && std::abs(glsl::dot(p, l.v)) <= glsl::dot(l.v, l.v);
    });
}

// Facing the surface's point from about the mirror direction, at distance 1 and across the horizon too; in units of `size`.
ExactLight randomReflected(Random& random, double degrees, double size)
{
    const vec3 v = viewAt(degrees);
    const double spread = size * (random.uniform() < 0.5 ? 0.25 : 0.9);
    ExactLight l;
    l.center =
        glsl::normalize(vec3(-v.x, 0, v.z) + spread * vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    const vec3 x = glsl::normalize(glsl::cross(-l.center, random.direction()));
    l.u = size * random.uniform(0.15, 0.75) * x;
    l.v = size * random.uniform(0.15, 0.75) * glsl::cross(-l.center, x);
    return l;
}

double rectangle(const Ltc& lobe, const ExactLight& l)
{
    return glsl::ltcRectangle(lobe, l.center, l.u, l.v);
}

double polygon(const Ltc& lobe, const vec3& center, const std::vector<vec3>& vertices)
{
    double square = 0.0;
    for (const vec3& v : vertices) square = std::max(square, glsl::dot(v, v));
    glsl::LtcSum sum = glsl::ltcSum(lobe, center, square);
    for (const vec3& v : vertices) sum = glsl::withVertex(sum, v);
    return glsl::ltcShare(sum);
}

double mean(const std::vector<double>& values)
{
    double sum = 0.0;
    for (double v : values) sum += v / double(values.size());
    return sum;
}

}  // namespace

// area-lights.md 8
TEST(ltc, RectangleAgainstTheLobe)
{
    Random random(1);
    std::vector<double> errors;
    for (int i = 0; i < 960; ++i) {
        const double roughness = 0.05 + 0.95 * (i % 16 + random.uniform()) / 16.0;
        const double degrees = 85.0 * (i / 16 % 15 + random.uniform()) / 15.0;
        const ExactLight l = randomReflected(random, degrees, 1.0);
        errors.push_back(std::abs(rectangle(lobeOf(roughness, degrees), l) - shareOfLobe(roughness, degrees, l)));
    }
    EXPECT_LT(mean(errors), 0.007);
    EXPECT_LT(percentile(errors, 0.95), 0.027);
}

// Of lights as large as the highlight the table's interpolation must not move it.
TEST(ltc, SmallRectangleInNarrowLobes)
{
    Random random(2);
    std::vector<double> errors;
    for (int i = 0; i < 480; ++i) {
        const double roughness = 0.03 + 0.17 * (i % 16 + random.uniform()) / 16.0;
        const double degrees = 85.0 * (i / 16 % 15 + random.uniform()) / 15.0;
        const ExactLight l = randomReflected(random, degrees, 4.0 * roughness * roughness);
        errors.push_back(std::abs(rectangle(lobeOf(roughness, degrees), l) - shareOfLobe(roughness, degrees, l)));
    }
    EXPECT_LT(mean(errors), 0.002);
    EXPECT_LT(percentile(errors, 0.95), 0.007);
}

TEST(ltc, LeakAgainstQuadrature)
{
    for (double roughness : {0.03, 0.1, 0.25, 0.4, 0.7, 1.0})
        for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
            const Ltc lobe = lobeOf(roughness, degrees);
            const vec4& m = lobe.inverse;
            const glsl::mat3 matrix = glm::inverse(glsl::mat3(vec3(m.x, 0, m.z), vec3(0, 1, 0), vec3(m.y, 0, m.w)));
            const int side = 400;
            double below = 0.0;
            for (int i = 0; i < side; ++i)
                for (int j = 0; j < side; ++j) {
                    const double angle = 2.0 * pi * (i + 0.5) / side, square = (j + 0.5) / side;
                    const double sine = std::sqrt(square);
                    const vec3 d = matrix * vec3(sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1.0 - square));
                    below += d.z < 0.0 ? 1.0 / (side * side) : 0.0;
                }
            EXPECT_NEAR(lobe.leak, below, 2e-3) << roughness << " " << degrees;
            EXPECT_LT(lobe.leak, 0.25) << roughness << " " << degrees;
        }
}

TEST(ltc, TheWholeHemisphereIsTheWholeLobe)
{
    for (double roughness : {0.0, 0.01, 0.1, 0.3, 0.6, 1.0})
        for (double degrees : {0.0, 40.0, 70.0, 85.0, 90.0}) {
            const Ltc lobe = lobeOf(roughness, degrees);
            const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
            EXPECT_NEAR(glsl::ltcRectangle(lobe, 1e-9 * z, y, x), 1.0, 1e-6) << roughness << " " << degrees;
            EXPECT_NEAR(glsl::ltcDisc(lobe, 1e-9 * z, y, x), 1.0, 1e-6) << roughness << " " << degrees;
            EXPECT_EQ(glsl::ltcSphere(lobe, 0.5 * z, 1.0), 1.0);
            // A room: walls that go on below the floor, and a ceiling.
            double room = glsl::ltcRectangle(lobe, z, y, x);
            for (double side : {1.0, -1.0}) {
                room += glsl::ltcRectangle(lobe, side * x, side * z, y) + glsl::ltcRectangle(lobe, side * y, x, side * z);
            }
            EXPECT_NEAR(room, 1.0, 1e-9) << roughness << " " << degrees;
        }
}

TEST(ltc, NothingFromBelowBehindOrNoArea)
{
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const double degrees = random.uniform(0.0, 90.0);
        const Ltc lobe = lobeOf(random.uniform(), degrees);
        ExactLight l = randomReflected(random, degrees, 0.5);
        EXPECT_EQ(rectangle(lobe, {-l.center, l.u, l.v}), 0.0);
        EXPECT_EQ(rectangle(lobe, {l.center, l.v, l.u}), 0.0);
        EXPECT_LT(polygon(lobe, l.center, {l.v + l.u, l.v - l.u, -l.v - l.u, l.u - l.v}), 1.0);
        EXPECT_LT(polygon(lobe, l.center, {l.u - l.v, -l.v - l.u, l.v - l.u, l.v + l.u}), 1e-12);
        l.center.z = -0.51 - random.uniform();
        EXPECT_EQ(rectangle(lobe, l), 0.0);
        EXPECT_EQ(glsl::ltcDisc(lobe, l.center, 0.5 * glsl::normalize(l.u), 0.5 * glsl::normalize(l.v)), 0.0);
        EXPECT_EQ(glsl::ltcSphere(lobe, l.center, 0.5), 0.0);
        EXPECT_EQ(polygon(lobe, l.center, {l.u, l.v, -l.u, -l.v}), 0.0);
        EXPECT_EQ(glsl::ltcRectangle(lobe, vec3(0, 0, 1), vec3(1, 0, 0), vec3(0)), 0.0);
        EXPECT_EQ(glsl::ltcDisc(lobe, vec3(0, 0, 1), vec3(0), vec3(0)), 0.0);
        EXPECT_EQ(glsl::ltcSphere(lobe, vec3(0, 0, 1), 0.0), 0.0);
    }
}

TEST(ltc, OfTheCosineLobeItIsTheFormFactor)
{
    const Ltc cosine = {vec4(1, 0, 0, 1), 0.0};
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        ExactLight l = randomLight(random, std::pow(10.0, random.uniform(-5.0, 0.0)));
        if (i % 2) l.center.z *= glsl::length(l.u);
        const double exact = glsl::rectangleFormFactor(l.center, l.u, l.v), bound = 1e-12 * glsl::length(glsl::cross(l.u, l.v));
        EXPECT_NEAR(rectangle(cosine, l), exact, bound);
        EXPECT_NEAR(polygon(cosine, l.center, {l.u + l.v, l.v - l.u, -l.u - l.v, l.u - l.v}), exact, bound);
    }
}

TEST(ltc, PartsAddUp)
{
    Random random(5);
    for (int i = 0; i < 4000; ++i) {
        const double roughness = random.uniform(), degrees = random.uniform(0.0, 90.0);
        const Ltc lobe = lobeOf(roughness, degrees);
        const ExactLight l = randomReflected(random, degrees, random.uniform(0.01, 1.0));
        const double cut = random.uniform(-1.0, 1.0);
        const double whole = rectangle(lobe, l);
        const ExactLight left = {l.center + 0.5 * (cut - 1.0) * l.u, 0.5 * (cut + 1.0) * l.u, l.v};
        const ExactLight right = {l.center + 0.5 * (cut + 1.0) * l.u, 0.5 * (1.0 - cut) * l.u, l.v};
        EXPECT_NEAR(rectangle(lobe, left) + rectangle(lobe, right), whole, 1e-9);
        const double quarter = rectangle(lobe, {l.center + 0.5 * (l.u + l.v), 0.5 * l.u, 0.5 * l.v});
        const std::vector<vec3> concave = {vec3(0), l.v, l.v - l.u, -l.u - l.v, l.u - l.v, l.u};
        EXPECT_NEAR(polygon(lobe, l.center, concave), whole - quarter, 1e-9);
    }
}

TEST(ltc, DiscAgainstAPolygonOfManyVertices)
{
    Random random(6);
    std::vector<double> errors;
    for (int i = 0; i < 1000; ++i) {
        const double roughness = random.uniform(0.1, 1.0), degrees = random.uniform(0.0, 85.0);
        const Ltc lobe = lobeOf(roughness, degrees);
        ExactLight l = randomReflected(random, degrees, 1.0);
        l.v *= glsl::length(l.u) / glsl::length(l.v);
        std::vector<vec3> rim;
        for (int k = 0; k < 500; ++k) rim.push_back(std::cos(2.0 * pi * k / 500) * l.u + std::sin(2.0 * pi * k / 500) * l.v);
        errors.push_back(std::abs(glsl::ltcDisc(lobe, l.center, l.u, l.v) - polygon(lobe, l.center, rim)));
    }
    EXPECT_LT(mean(errors), 1e-4);
    EXPECT_LT(percentile(errors, 1.0), 5e-3);
}

// area-lights.md 4: mean error over mean share.
TEST(ltc, SphereAgainstTheLobe)
{
    Random random(7);
    for (double radius : {5.0, 10.0, 20.0, 50.0})
        for (double roughness : {0.1, 0.3, 0.6}) {
            double difference = 0.0, sum = 0.0;
            for (int i = 0; i < 60; ++i) {
                const double degrees = random.uniform(0.0, 80.0);
                const double spread = std::max(2.0 * roughness * roughness, radius * degree);
                const vec3 v = viewAt(degrees);
                const vec3 center = glsl::normalize(
                    vec3(-v.x, 0, v.z) + spread * vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
                const double exact = shareOfLobe(roughness, degrees, 100,
                                                 [&](const vec3& l) { return glsl::dot(l, center) > std::cos(radius * degree); });
                const double found = glsl::ltcSphere(lobeOf(roughness, degrees), 7.0 * center, 7.0 * std::sin(radius * degree));
                difference += std::abs(found - exact);
                sum += exact;
            }
            EXPECT_LT(difference / sum, 0.07) << radius << " " << roughness;
        }
}

TEST(ltc, RectangleInSinglePrecision)
{
    if (!single::isExact) GTEST_SKIP() << "the compiler takes constants as doubles";
    Random random(8);
    for (double size : {1.0, 0.1, 1e-2, 1e-3, 1e-5}) {
        std::vector<double> errors;
        for (int i = 0; i < 20000; ++i) {
            const double roughness = random.uniform(0.05, 1.0), degrees = random.uniform(0.0, 85.0);
            const glm::vec4 inverse(lobeOf(roughness, degrees).inverse);
            const Ltc lobe = {vec4(inverse), glsl::ltcLeak(vec4(inverse))};
            ExactLight e = randomReflected(random, degrees, 1.0);
            e.u *= size;
            e.v *= size;
            const SingleLight l = rounded(e);
            const double exactly = rectangle(lobe, exact(l)), found = double(single::ltcRectangle(inverse, l.center, l.u, l.v));
            const double solidAngle = 4.0 * glsl::length(e.u) * glsl::length(e.v);
            errors.push_back(std::abs(found - exactly) / std::min(1.0, solidAngle / (pi * std::pow(roughness, 4))));
        }
        EXPECT_LT(percentile(errors, 0.99), 1e-5) << size;
        EXPECT_LT(percentile(errors, 1.0), 1e-4) << size;
    }
}

TEST(ltc, FrameHoldsTheView)
{
    Random random(9);
    for (int i = 0; i < 1000; ++i) {
        const vec3 n = random.direction();
        vec3 v = i % 3 ? random.direction() : glsl::normalize(n + 1e-7 * random.uniform() * random.direction());
        if (i % 50 == 0) v = n;
        const glsl::mat3 frame = glsl::ltcFrame(n, v);
        const glsl::mat3 one = glsl::transpose(frame) * frame;
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(one[j][k], j == k ? 1.0 : 0.0, 1e-9);
        const vec3 local = glsl::transpose(frame) * v;
        EXPECT_NEAR(local.y, 0.0, 2e-6);
        EXPECT_GT(local.x, -2e-6);
        EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-9);
    }
}

TEST(ltc, TheTableIsWhatTheToolFits)
{
    using osgEnvLight::ltcSide;
    for (int y : {6, 16, 31}) {
        const auto row = fitLtcRow(double(y) / (ltcSide - 1), ltcSide);
        for (int x = 0; x < ltcSide; ++x)
            for (size_t k = 0; k < 4; ++k) {
                const int kept = osgEnvLight::ltcTable[size_t(4 * (y * ltcSide + x)) + k];
                EXPECT_NEAR(row[size_t(x)][k], kept * osgEnvLight::ltcUnit, 1e-3) << x << " " << y << " " << k;
            }
    }
}

TEST(ltc, TheTextureIsLinearAndClamped)
{
    const osg::ref_ptr<osg::Texture2D> table = osgEnvLight::makeLtcTable();
    EXPECT_EQ(table->getInternalFormat(), GL_RGBA16F_ARB);
    EXPECT_EQ(table->getFilter(osg::Texture::MAG_FILTER), osg::Texture::LINEAR);
    EXPECT_EQ(table->getWrap(osg::Texture::WRAP_T), osg::Texture::CLAMP_TO_EDGE);
    EXPECT_EQ(table->getImage()->s(), osgEnvLight::ltcSide);
}

// In all directions above the horizon: a small light's share over its solid angle.
TEST(ltc, DensityIsTheShareOfSmallLights)
{
    Random random(8);
    const double size = 1e-3;  // of its second derivatives a lobe of roughness .2 feels 1e-3
    for (int i = 0; i < 200; ++i) {
        const Ltc lobe = lobeOf(random.uniform(0.2, 1.0), random.uniform(0.0, 80.0));
        vec3 l = random.direction();
        l.z = std::abs(l.z) + 0.01;
        l = glsl::normalize(l);
        const vec3 x = glsl::normalize(glsl::cross(-l, vec3(0.3, 0.5, 0.7)));
        const double share = glsl::ltcRectangle(lobe, l, size * x, size * glsl::cross(-l, x));
        EXPECT_NEAR(share, glsl::ltcDensity(lobe, l) * 4.0 * size * size, 2e-3 * share);
    }
}

}  // namespace ltc_test
