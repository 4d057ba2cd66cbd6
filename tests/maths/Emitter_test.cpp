// SPDX-License-Identifier: MIT
// Area lights where their nodes' matrices put them.
#include "surface/Emitter.h"

#include "surface/Outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Maths.h"

namespace Emitter_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Emitter;
using osgEnvLight::Outline;
using testmaths::Random;

namespace
{

const double notANumber = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

osg::ref_ptr<AreaLight> rectangle(const osg::Vec3d& center, const osg::Vec3d& u, const osg::Vec3d& v)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRectangle(center, u, v);
    return light;
}

osg::ref_ptr<AreaLight> disc(const osg::Vec3d& normal, double radius)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setDisc(osg::Vec3d(1, 2, 3), normal, radius);
    return light;
}

osg::ref_ptr<AreaLight> sphere(double radius)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setSphere(osg::Vec3d(1, 2, 3), radius);
    return light;
}

osg::ref_ptr<AreaLight> polygon(const std::vector<osg::Vec3>& vertices)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setPolygon(*osg::ref_ptr<osg::Vec3Array>(new osg::Vec3Array(vertices.begin(), vertices.end())));
    return light;
}

// An L of area 3 in the plane z = 1, which faces +z.
const std::vector<osg::Vec3> letter = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};

std::string problemOf(const AreaLight& light, const osg::Matrixd& matrix = osg::Matrixd())
{
    Emitter emitter;
    return placeEmitter(light, matrix, emitter);
}

Emitter placed(const AreaLight& light, const osg::Matrixd& matrix = osg::Matrixd())
{
    Emitter emitter;
    EXPECT_EQ("", placeEmitter(light, matrix, emitter));
    return emitter;
}

osg::Matrixd randomMatrix(Random& random, bool mirrored)
{
    osg::Matrixd m;
    do {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m(i, j) = random.uniform(-1, 1);
        for (int j = 0; j < 3; ++j) m(3, j) = random.uniform(-5, 5);
    } while (std::abs(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), m) *
                      (osg::Matrixd::transform3x3(osg::Vec3d(1, 0, 0), m) ^ osg::Matrixd::transform3x3(osg::Vec3d(0, 1, 0), m))) <
             0.1);
    const bool mirrors =
        osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), m) *
            (osg::Matrixd::transform3x3(osg::Vec3d(1, 0, 0), m) ^ osg::Matrixd::transform3x3(osg::Vec3d(0, 1, 0), m)) <
        0.0;
    return mirrors == mirrored ? m : osg::Matrixd::scale(-1, 1, 1) * m;
}

void expectNear(const osg::Vec3d& a, const osg::Vec3d& b, double slack = 1e-12)
{
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], slack);
}

osg::Vec3d sumOfTriangles(const Emitter& e)
{
    osg::Vec3d sum;
    for (size_t i = 0; i < e.triangles.size(); i += 3) {
        const osg::Vec3d& a = e.vertices[e.triangles[i]];
        const osg::Vec3d t = (e.vertices[e.triangles[i + 1]] - a) ^ (e.vertices[e.triangles[i + 2]] - a);
        EXPECT_GT(t * e.normal, 0.0);  // each turns as the whole
        sum += t * 0.5;
    }
    return sum;
}

}  // namespace

TEST(Emitter, TheLitSideIsWhatAMatrixMakesOfIt)
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const osg::Matrixd m = randomMatrix(random, i % 2 == 1);
        const osg::Vec3d u(1, 0.2, -0.3), v(0.1, 2, 0.4);
        osg::Vec3d normal = u ^ v;
        for (const auto& light : {rectangle(osg::Vec3d(1, 2, 3), u, v), disc(normal, 2.0), polygon(letter)}) {
            const bool flat = light->getShape() == AreaLight::POLYGON;
            const Emitter e = placed(*light, m);
            // A point on the lit side stays there.
            const osg::Vec3d before = flat ? osg::Vec3d(1, 1, 1) : osg::Vec3d(1, 2, 3);
            const osg::Vec3d off = flat ? osg::Vec3d(0, 0, 1) : normal;
            EXPECT_GT(((before + off) * m - e.center) * e.normal, 0.0);
            EXPECT_NEAR(0.0, (before * m - e.center) * e.normal, 1e-6);
            EXPECT_NEAR(1.0, e.normal.length(), 1e-12);
            if (e.shape != AreaLight::POLYGON) {
                EXPECT_GT((e.u ^ e.v) * e.normal, 0.0);
            }
        }
    }
}

TEST(Emitter, ARectangleMayBeScaledMirroredAndSheared)
{
    const auto light = rectangle(osg::Vec3d(1, 0, 0), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 2, 0));
    EXPECT_DOUBLE_EQ(8.0, placed(*light).area);
    const Emitter scaled = placed(*light, osg::Matrixd::scale(3, 0.5, 7) * osg::Matrixd::translate(1, 1, 1));
    EXPECT_DOUBLE_EQ(12.0, scaled.area);
    expectNear(osg::Vec3d(4, 1, 1), scaled.center);
    const osg::Matrixd shear(1, 0, 0, 0, 0.7, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    EXPECT_DOUBLE_EQ(8.0, placed(*light, shear).area);
    expectNear(osg::Vec3d(0, 0, 1), placed(*light, osg::Matrixd::scale(-1, 1, 1)).normal);
    expectNear(osg::Vec3d(0, 0, -1), placed(*light, osg::Matrixd::scale(1, 1, -1)).normal);
    EXPECT_DOUBLE_EQ(std::sqrt(5.0), placed(*light).extent());
    EXPECT_DOUBLE_EQ(8.0, placed(*light, osg::Matrixd::scale(1, 1, 0)).area);  // pressed into its own plane
}

TEST(Emitter, AStretchedDiscIsAPolygonOfItsArea)
{
    const auto light = disc(osg::Vec3d(0.2, -0.4, 3.0), 1.5);
    Random random(2);
    const Emitter turned = placed(*light, osg::Matrixd::rotate(1.0, osg::Vec3d(1, 2, 3)) * osg::Matrixd::scale(-2, 2, 2));
    EXPECT_EQ(AreaLight::DISC, turned.shape);
    EXPECT_NEAR(3.0, turned.radius(), 1e-12);
    EXPECT_NEAR(0.0, turned.u * turned.v, 1e-12);
    EXPECT_NEAR(3.0, turned.v.length(), 1e-12);
    for (int i = 0; i < 20; ++i) {
        const osg::Matrixd m = randomMatrix(random, i % 2 == 1);
        const osg::Vec3d u = osg::Matrixd::transform3x3(light->getU(), m), v = osg::Matrixd::transform3x3(light->getV(), m);
        const Emitter e = placed(*light, m);
        ASSERT_EQ(AreaLight::POLYGON, e.shape);
        EXPECT_EQ(AreaLight::mostVertices, e.vertices.size());
        EXPECT_NEAR(osg::PI * (u ^ v).length(), e.area, 1e-12 * e.area);
        EXPECT_NEAR(e.area, sumOfTriangles(e) * e.normal, 1e-12 * e.area);
    }
}

TEST(Emitter, AStretchedSphereKeepsItsVolume)
{
    const auto light = sphere(1.5);
    const Emitter e = placed(*light, osg::Matrixd::rotate(1.0, osg::Vec3d(1, 2, 3)) * osg::Matrixd::scale(2, -2, 2));
    EXPECT_NEAR(3.0, e.radius(), 1e-12);
    EXPECT_NEAR(36.0 * osg::PI, e.area, 1e-10);
    EXPECT_NEAR(1.5 * std::cbrt(6.0), placed(*light, osg::Matrixd::scale(1, 2, 3)).radius(), 1e-12);
    light->setTwoSided(true);
    EXPECT_FALSE(placed(*light).twoSided);
}

TEST(Emitter, APolygonMayBeConcave)
{
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        const osg::Matrixd m = randomMatrix(random, i % 2 == 1);
        const Emitter e = placed(*polygon(letter), m);
        ASSERT_EQ(12u, e.triangles.size());
        const osg::Vec3d edges =
            osg::Matrixd::transform3x3(osg::Vec3d(1, 0, 0), m) ^ osg::Matrixd::transform3x3(osg::Vec3d(0, 1, 0), m);
        EXPECT_NEAR(3.0 * edges.length(), e.area, 1e-12);
        EXPECT_NEAR(e.area, sumOfTriangles(e) * e.normal, 1e-12);
        osg::Vec3d mean;
        for (const osg::Vec3d& p : e.vertices) mean += p;
        expectNear(osg::Vec3d(), mean);
    }
}

// Stars of random rays, spirals and combs, whose area is known.
TEST(Emitter, TrianglesMakeUpEveryOutline)
{
    Random random(4);
    for (int i = 0; i < 300; ++i) {
        const int n = 3 + i % 30;
        std::vector<osg::Vec3d> star;
        for (int k = 0; k < n; ++k) {
            const double r = random.uniform(0.05, 1.0), angle = 2.0 * osg::PI * k / n;
            star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
        }
        const Outline outline(star);
        EXPECT_FALSE(outline.crosses());
        EXPECT_EQ(size_t(3 * (n - 2)), outline.triangles().size());
    }
    std::vector<osg::Vec3d> comb = {{0, 0, 0}, {15, 0, 0}};
    for (int k = 15; k >= 0; --k) comb.emplace_back(k, k % 2 ? 5.0 : 1.0, 0.0);
    EXPECT_EQ(3 * (comb.size() - 2), Outline(comb).triangles().size());
    // A frame: the hole's edge is joined to the outer one by an edge there and back.
    const std::vector<osg::Vec3d> frame = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                           {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    EXPECT_FALSE(Outline(frame).crosses());
    EXPECT_NEAR(8.0, Outline(frame).area(), 1e-12);
    EXPECT_FALSE(Outline(frame).triangles().empty());
    // Vertices along an edge, and one twice.
    const std::vector<osg::Vec3d> straight = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    EXPECT_EQ(6u, Outline(straight).vertices().size());
    EXPECT_FALSE(Outline(straight).triangles().empty());
}

TEST(Emitter, WhatCanNotLightIsRefused)
{
    const auto square = rectangle(osg::Vec3d(), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0));
    EXPECT_EQ("has no area", problemOf(*square, osg::Matrixd::scale(0, 0, 0)));
    EXPECT_EQ("has no area", problemOf(*square, osg::Matrixd::scale(1, 0, 1)));
    EXPECT_EQ("has no area", problemOf(*rectangle(osg::Vec3d(), osg::Vec3d(1, 1, 0), osg::Vec3d(2, 2, 0))));
    EXPECT_EQ("has no area", problemOf(*disc(osg::Vec3d(), 1.0)));
    EXPECT_EQ("has no area", problemOf(*disc(osg::Vec3d(0, 0, 1), 0.0)));
    EXPECT_EQ("has no area", problemOf(*sphere(0.0)));
    EXPECT_EQ("has no area", problemOf(*sphere(1.0), osg::Matrixd::scale(1, 1, 0)));
    EXPECT_EQ("has no area", problemOf(*polygon({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}})));
    EXPECT_EQ("has no area", problemOf(*polygon(letter), osg::Matrixd::scale(0, 1, 1)));
    EXPECT_EQ("has a number that is not finite", problemOf(*square, osg::Matrixd::translate(notANumber, 0, 0)));
    EXPECT_EQ("has a number that is not finite", problemOf(*square, osg::Matrixd::scale(notANumber, 1, 1)));
    EXPECT_EQ("has a number that is not finite", problemOf(*square, osg::Matrixd::scale(1e200, 1e200, 1e200)));
    EXPECT_EQ("has a number that is not finite", problemOf(*sphere(infinity)));
    EXPECT_EQ("has a number that is not finite",
              problemOf(*rectangle(osg::Vec3d(notANumber, 0, 0), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0))));
    EXPECT_EQ("has a number that is not finite", problemOf(*polygon({{0, 0, 0}, {1, 0, 0}, {1, float(notANumber), 0}})));
    EXPECT_EQ("has less than three vertices", problemOf(*polygon({{0, 0, 0}, {1, 0, 0}})));
    EXPECT_EQ("has more than 32 vertices", problemOf(*polygon(std::vector<osg::Vec3>(33))));
    EXPECT_EQ("is not flat", problemOf(*polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1f}, {0, 1, 0}})));
    EXPECT_EQ("has edges that cross", problemOf(*polygon({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {4, 3, 0}})));
    // A bow tie of unequal loops, joined at a vertex.
    EXPECT_EQ("has edges that cross", problemOf(*polygon({{0, 0, 0}, {1, 1, 0}, {3, 3, 0}, {3, 0, 0}, {1, 1, 0}, {0, 1, 0}})));
    square->setEmission(AreaLight::RADIANCE, osg::Vec3f(1, float(infinity), 1));
    EXPECT_EQ("has a number that is not finite", problemOf(*square));
    osg::ref_ptr<AreaLight> none = new AreaLight;
    none->setShape(AreaLight::POLYGON);
    EXPECT_EQ("has less than three vertices", problemOf(*none));
}

TEST(Emitter, FluxIsRadianceTimesPiTimesTheArea)
{
    for (const auto& light : {rectangle(osg::Vec3d(), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 2, 0)), disc(osg::Vec3d(0, 0, 1), 0.7),
                              sphere(0.3), polygon(letter)})
        for (const bool twoSided : {false, true})
            for (const double scale : {1.0, 0.01, 40.0}) {
                const osg::Matrixd m = osg::Matrixd::scale(scale, scale, -scale);
                light->setTwoSided(twoSided);
                light->setFlux(osg::Vec3f(3, 6, 9));
                const Emitter byFlux = placed(*light, m);
                EXPECT_NEAR(6.0, byFlux.flux(), 1e-12);
                const double sides = twoSided && light->getShape() != AreaLight::SPHERE ? 2.0 : 1.0;
                EXPECT_NEAR(9.0, byFlux.radiance[2] * osg::PI * byFlux.area * sides, 1e-12);
                light->setRadiance(osg::Vec3f(1, 2, 3));
                EXPECT_NEAR(2.0 * osg::PI * byFlux.area * sides, placed(*light, m).flux(), 1e-9 * byFlux.area);
            }
    const auto light = sphere(1.0);
    light->setRadiance(osg::Vec3f(-1, 0, 2));
    expectNear(osg::Vec3d(0, 0, 2), placed(*light).radiance);
}

TEST(Emitter, MovesAsItsMatrixWould)
{
    const osg::Matrixd m = osg::Matrixd::scale(2, 2, 2),
                       view = osg::Matrixd::lookAt(osg::Vec3d(3, 1, 2), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    for (const auto& light : {rectangle(osg::Vec3d(1, 0, 0), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 2, 1)),
                              disc(osg::Vec3d(1, 0, 1), 0.7), sphere(0.3), polygon(letter)}) {
        const Emitter a = placed(*light, m).moved(view), b = placed(*light, m * view);
        expectNear(a.center, b.center);
        expectNear(a.normal, b.normal);
        expectNear(a.u, b.u);
        expectNear(a.v, b.v);
        ASSERT_EQ(a.vertices.size(), b.vertices.size());
        for (size_t i = 0; i < a.vertices.size(); ++i) expectNear(a.vertices[i], b.vertices[i]);
        EXPECT_NEAR(a.area, b.area, 1e-12);
    }
}

}  // namespace Emitter_test
