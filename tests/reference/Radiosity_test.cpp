// SPDX-License-Identifier: MIT
// Light from surface to surface against closed forms (systems.md 1.7): means over squares, plates, boxes, spheres.
#include <osg/Geometry>

#include <gtest/gtest.h>

#include "Maths.h"
#include "Oracles.h"
#include "Traced.h"

namespace Radiosity_test
{

using testmaths::pi;
namespace oracle = testmaths::oracle;

namespace
{

const FunctionEnvironment day([](const glm::dvec3&) { return 1.0; });
const FunctionEnvironment night([](const glm::dvec3&) { return 0.0; });

ReferenceOptions full(unsigned pass, unsigned passes)
{
    ReferenceOptions options = makeOptions(ReferenceOptions::MIS, pass, passes);
    options.paths = ReferenceOptions::FULL;
    return options;
}

// The numbers are the same at every run: 1 in 370 would lie beyond 3 standard errors, and none does.
void expectNear(const Estimate& e, double truth, double relative, const std::string& what, double bias = 1e-6)
{
    EXPECT_EQ(1024, e.pixels) << what;
    EXPECT_LE(std::abs(e.value - truth), 3.0 * e.error + bias * truth) << what << ": " << e.value << " +- " << e.error;
    EXPECT_LE(std::abs(e.value / truth - 1.0), relative) << what << ": " << e.value << " for " << truth;
}

osg::ref_ptr<osg::Geode> unitSquare(const osg::Vec3d& corner, const osg::Vec3d& b)
{
    return makeQuad(corner, osg::Vec3d(1, 0, 0), b);
}

// The mean over the unit square in the plane z = 0, seen from above it, is a form factor between finite patches.
void expectExchange(const osg::ref_ptr<osg::Geode>& other, double factor, const std::string& what)
{
    const osg::ref_ptr<osg::Node> floor = lambert(unitSquare(osg::Vec3d(), osg::Vec3d(0, 1, 0)), 1.0);
    const osg::ref_ptr<osg::Group> scene = together({floor, emissive(other, 1.0)});
    const Traced view = parallelView(*scene, osg::Vec3d(0.5, 0.5, 0.25), osg::Vec3d(0, 0, -1), 1.0, 32);
    for (const auto estimator : allEstimators) {
        ReferenceOptions options = makeOptions(estimator, 64, 8);
        options.antialias = true;
        const double relative = estimator == ReferenceOptions::UNIFORM ? 0.006 : 0.002;
        expectNear(estimateOf(view.render(day, options), Layer::BEAUTY), 1.0 - factor, relative, what + ", " + nameOf(estimator));
    }
    ReferenceOptions options = full(64, 8);
    options.antialias = true;
    expectNear(estimateOf(view.render(night, options), Layer::BEAUTY), factor, 0.005, what + ", emitting");
}

// The part of a unit sphere between two polar angles.
osg::ref_ptr<osg::Geode> spherePart(double from, double to, int rows, int columns)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double theta = from + (to - from) * j / rows, phi = 2.0 * pi * i / columns;
            vertices->push_back(osg::Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
    const auto at = [columns](int i, int j) { return unsigned(j * columns + i % columns); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            for (unsigned k : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)})
                triangles->push_back(k);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(triangles);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

}  // namespace

TEST(ReferenceRadiosity, UnitSquares)
{
    expectExchange(unitSquare(osg::Vec3d(0, 0, 1), osg::Vec3d(0, 1, 0)), oracle::parallelRectangles(1, 1, 1), "parallel");
    expectExchange(unitSquare(osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1)), oracle::perpendicularRectangles(1, 1, 1),
                   "perpendicular");
}

// Every wall alike: path after path is the geometric series, cut by Russian roulette, which must not show.
TEST(ReferenceRadiosity, ClosedBoxIsTheGeometricSeries)
{
    for (double rho : {0.1, 0.5, 0.8, 0.95}) {
        const osg::ref_ptr<osg::Geode> box = makeBox(osg::Vec3d(-1, -2, -0.5), osg::Vec3d(1, 2, 0.5));
        emissive(box, 0.3, rho);
        const Traced view = perspectiveView(*box, osg::Vec3d(0.7, 1.6, 0.1), osg::Vec3d(-1, -2, -0.5), 32, 90.0);
        // Roulette survives by rho: the number of bounces, and with it the sum, spreads by sqrt(rho) of its mean, from the
        // fourth on. Over 131 000 paths that is .3 % at most.
        const Estimate e = estimateOf(view.render(night, full(16, 8)), Layer::BEAUTY);
        expectNear(e, oracle::closedBox(0.3, rho), rho < 0.6 ? 0.002 : 0.01, "rho " + std::to_string(rho));
    }
}

TEST(ReferenceRadiosity, ParallelPlates)
{
    // From their middle the plates of 4000 end at the angle 2000: 1 / 2000^2 of the light is lost.
    const double half = 2000.0;
    const auto plate = [half](double z) {
        return makeQuad(osg::Vec3d(-half, -half, z), osg::Vec3d(2 * half, 0, 0), osg::Vec3d(0, 2 * half, 0));
    };
    const osg::ref_ptr<osg::Group> scene = together({emissive(plate(0), 1.0, 0.6), emissive(plate(1), 0.2, 0.8)});
    const auto [lower, upper] = oracle::parallelPlates(1.0, 0.2, 0.6, 0.8);
    const Traced down = parallelView(*scene, osg::Vec3d(0.3, 0.2, 0.5), osg::Vec3d(0, 0, -1), 0.1, 32);
    const Traced up = parallelView(*scene, osg::Vec3d(0.3, 0.2, 0.5), osg::Vec3d(0, 0, 1), 0.1, 32);
    // Paths wander: 6 bounces of mean length 1 stay far from the edge but for 1e-5.
    expectNear(estimateOf(down.render(night, full(16, 8)), Layer::BEAUTY), lower, 0.006, "lower", 1e-4);
    expectNear(estimateOf(up.render(night, full(16, 8)), Layer::BEAUTY), upper, 0.006, "upper", 1e-4);
}

TEST(ReferenceRadiosity, IntegratingSphere)
{
    // Points of a chord of an inscribed polyhedron see their own facets' neighbours a little differently: of the order of the
    // angle between facets squared, (pi / 128)^2 = 6e-4.
    const double cut = std::acos(1.0 - 2.0 * 0.25);  // a quarter of the area emits
    const double rho = 0.7;
    const osg::ref_ptr<osg::Group> scene =
        together({emissive(spherePart(0.0, cut, 64, 256), 1.0, rho), emissive(spherePart(cut, pi, 128, 256), 0.0, rho)});
    const Traced dark = perspectiveView(*scene, osg::Vec3d(), osg::Vec3d(0.3, 0.2, -1), 32, 20.0);
    const Traced bright = perspectiveView(*scene, osg::Vec3d(), osg::Vec3d(0.1, 0.2, 1), 32, 20.0);
    expectNear(estimateOf(dark.render(night, full(16, 8)), Layer::BEAUTY), oracle::integratingSphere(0.0, 0.25, rho), 0.006,
               "dark", 6e-4);
    expectNear(estimateOf(bright.render(night, full(16, 8)), Layer::BEAUTY), oracle::integratingSphere(1.0, 0.25, rho), 0.003,
               "bright", 6e-4);
}

TEST(ReferenceRadiosity, CavityUnderASky)
{
    const double opening = pi / 3.0;
    for (double rho : {0.5, 0.8}) {
        const osg::ref_ptr<osg::Node> bowl = emissive(spherePart(opening, pi, 128, 256), 0.0, rho);
        const Traced view = perspectiveView(*bowl, osg::Vec3d(), osg::Vec3d(0.3, 0.2, -1), 32, 20.0);
        // Light from the sky itself and by one more surface: the same sum whatever the estimator of the direct part.
        for (const auto estimator : allEstimators) {
            const bool blind = estimator != ReferenceOptions::MIS;
            if (blind && rho > 0.6) continue;  // as the last one, only longer
            ReferenceOptions options = full(blind ? 32 : 16, 8);
            options.estimator = estimator;
            expectNear(estimateOf(view.render(day, options), Layer::BEAUTY), oracle::sphericalCavity(rho, opening), 0.01,
                       std::string(nameOf(estimator)) + ", rho " + std::to_string(rho), 6e-4);
        }
    }
}

}  // namespace Radiosity_test
