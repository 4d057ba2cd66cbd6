// SPDX-License-Identifier: MIT
// The reference against closed forms (systems.md 1.7): skies, blockers and lobes.
#include <osgEnvLight/Material>

#include <osg/Geometry>

#include <gtest/gtest.h>

#include "Maths.h"
#include "Oracles.h"
#include "Traced.h"

namespace Oracles_test
{

using osgEnvLight::Material;
using testmaths::pi;
namespace oracle = testmaths::oracle;

namespace
{

const FunctionEnvironment constantSky([](const glm::dvec3&) { return 1.0; });

// The numbers are the same at every run: 1 in 370 would lie beyond 3 standard errors, and none does. Pictures are floats.
void expectWithin(const Estimate& e, double truth, double relative, const std::string& what)
{
    EXPECT_GT(e.pixels, 0) << what;
    EXPECT_LE(std::abs(e.value - truth), 3.0 * e.error + 1e-6 * truth) << what << ": " << e.value << " +- " << e.error;
    EXPECT_LE(std::abs(e.value / truth - 1.0), relative) << what << ": " << e.value << " for " << truth;
    EXPECT_LE(e.error, relative * truth) << what;
}

osg::ref_ptr<osg::Geode> receiver()
{
    osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(-0.01, -0.01, 0), osg::Vec3d(0.02, 0, 0), osg::Vec3d(0, 0.02, 0));
    lambert(quad, 1.0);
    return quad;
}

// The receiver's middle from just above it: what lies elsewhere is out of the way. In a window this small all pixels see the
// same point: a form factor changes by its part across it, and evenly to both sides.
Traced pointView(osg::Node& scene)
{
    return parallelView(scene, osg::Vec3d(0, 0, 1e-3), osg::Vec3d(0, 0, -1), 1e-5, 32);
}

// Over 1024 pixels half a million independent samples leave .14 % of the standard deviation of one, which for what does not
// look for the light is of the order of the mean, and several times a small one; the scrambled ones of MIS far less.
ReferenceOptions enough(ReferenceOptions::Estimator estimator, double truth = 1.0)
{
    // Of a hundredth one sample in a hundred brings something: 1.3 %, and half of it by four times the samples.
    return estimator == ReferenceOptions::MIS ? makeOptions(estimator, 64, 4)
                                              : makeOptions(estimator, 32, truth < 0.05 ? 64 : 16);
}

// Irradiance over pi at a receiver that is white.
void expectSky(const Environment& sky, double truth, const std::string& what)
{
    const osg::ref_ptr<osg::Geode> quad = receiver();
    const Traced scene = pointView(*quad);
    for (const auto estimator : allEstimators) {
        const ReferenceResult result = scene.render(sky, enough(estimator, truth));
        const bool blind = estimator != ReferenceOptions::MIS;
        expectWithin(estimateOf(result, Layer::BEAUTY), truth, blind ? 0.02 : 0.002, what + ", " + nameOf(estimator));
    }
}

// A blocker takes its form factor from the constant sky; lit up under a black one it gives as much.
void expectBlocker(const osg::ref_ptr<osg::Geode>& blocker, double factor, const std::string& what)
{
    const osg::ref_ptr<osg::Group> scene = together({receiver(), emissive(blocker, 1.0)});
    const Traced view = pointView(*scene);
    for (const auto estimator : allEstimators) {
        const ReferenceResult result = view.render(constantSky, enough(estimator), {Layer::OCCLUSION});
        const std::string how = what + ", " + nameOf(estimator);
        expectWithin(estimateOf(result, Layer::BEAUTY), 1.0 - factor, estimator == ReferenceOptions::MIS ? 0.002 : 0.006, how);
        expectWithin(estimateOf(result, Layer::OCCLUSION), factor, 0.02, how + ", occlusion");
    }
    ReferenceOptions options = enough(ReferenceOptions::MIS);
    options.paths = ReferenceOptions::FULL;
    const FunctionEnvironment night([](const glm::dvec3&) { return 0.0; });
    expectWithin(estimateOf(view.render(night, options), Layer::BEAUTY), factor, 0.005, what + ", emitting");
}

osg::ref_ptr<osg::Geode> makeDisc(double radius, double height, int corners)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back(osg::Vec3(0, 0, float(height)));
    for (int i = 0; i <= corners; ++i) {
        const double phi = 2.0 * pi * i / corners;
        vertices->push_back(osg::Vec3d(radius * std::cos(phi), radius * std::sin(phi), height));
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, corners + 2));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

}  // namespace

TEST(ReferenceOracles, ConvexBodyInAFurnaceShowsItsAlbedo)
{
    const osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(), 1.0, 64);
    lambert(sphere, 0.7);
    const Traced view = perspectiveView(*sphere, osg::Vec3d(3, 2, 1), osg::Vec3d(), 32);
    // By the cosine every sample brings the same: no noise but in what the interpolated normals see below their facets.
    ReferenceOptions options = makeOptions(ReferenceOptions::COSINE, 16, 2);
    options.paths = ReferenceOptions::UNOCCLUDED;
    const Picture p = view.render(constantSky, options).mean(Layer::BEAUTY);
    int covered = 0;
    for (size_t i = 0; i < p.pixels(); ++i)
        if (p.rgba[4 * i + 3] > 0.0f) {
            ++covered;
            EXPECT_NEAR(p.rgba[4 * i], 0.7f, 1e-6f);
        }
    EXPECT_GT(covered, 300);
    for (const auto estimator : {ReferenceOptions::UNIFORM, ReferenceOptions::MIS}) {
        options = makeOptions(estimator, 256, 8);
        options.paths = ReferenceOptions::UNOCCLUDED;
        expectWithin(estimateOf(view.render(constantSky, options), Layer::BEAUTY), 0.7, 0.002, nameOf(estimator));
    }
}

TEST(ReferenceOracles, WhiteMetalInAFurnaceReflectsEverything)
{
    for (double roughness : {0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
        const osg::ref_ptr<osg::Geode> quad = receiver();
        Material::setCookTorrance(*quad->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, float(roughness));
        for (double degrees : {0.0, 45.0, 75.0}) {
            const double a = degrees * pi / 180.0;
            const osg::Vec3d towards(std::sin(a), 0, std::cos(a));
            const Traced view = parallelView(*quad, towards * 1e-2, -towards, 1e-5, 32);
            const Estimate e = estimateOf(view.render(constantSky, makeOptions(ReferenceOptions::MIS, 64, 4)), Layer::BEAUTY);
            // Single and multiple scattering sum to 1 by construction, up to the table's own error between its nodes.
            EXPECT_NEAR(e.value, 1.0, 0.003 + 4.0 * e.error) << "roughness " << roughness << " at " << degrees;
            EXPECT_LE(e.error, 1e-3);
        }
    }
}

TEST(ReferenceOracles, PhongLobe)
{
    for (double n : {1.0, 8.0, 100.0, 2000.0}) {
        const osg::ref_ptr<osg::Geode> quad = receiver();
        Material::setPhong(*quad->getOrCreateStateSet(), osg::Vec3f(0, 0, 0), osg::Vec3f(1, 1, 1), float(n));
        const Traced view = pointView(*quad);
        for (double k : {0.0, 1.0, 4.0}) {
            const FunctionEnvironment sky([k](const glm::dvec3& d) { return d.z > 0.0 ? std::pow(d.z, k) : 0.0; });
            const double truth = (n + 2.0) / (2.0 * pi) * oracle::cosineLobeWithCosine(n + k);
            const std::string what = "exponent " + std::to_string(n) + ", sky cos^" + std::to_string(k);
            const ReferenceResult mis = view.render(sky, makeOptions(ReferenceOptions::MIS, 64, 4));
            expectWithin(estimateOf(mis, Layer::BEAUTY), truth, 0.002, what);
            if (n > 10.0) continue;  // blind to the lobe, the others would take long
            for (const auto estimator : {ReferenceOptions::COSINE, ReferenceOptions::UNIFORM})
                expectWithin(estimateOf(view.render(sky, enough(estimator)), Layer::BEAUTY), truth, 0.02, what);
        }
    }
}

TEST(ReferenceOracles, CosinePowerSkies)
{
    expectSky(constantSky, 1.0, "constant sky");
    for (double k : {1.0, 4.0, 16.0})
        expectSky(FunctionEnvironment([k](const glm::dvec3& d) { return d.z > 0.0 ? std::pow(d.z, k) : 0.0; }),
                  oracle::powerSky(k), "sky cos^" + std::to_string(int(k)));
}

TEST(ReferenceOracles, HalfSkies)
{
    for (double degrees : {0.0, 30.0, 60.0, 90.0, 120.0}) {
        const double t = degrees * pi / 180.0;
        const glm::dvec3 axis(std::sin(t), 0.0, std::cos(t));
        expectSky(FunctionEnvironment([axis](const glm::dvec3& d) { return glm::dot(d, axis) > 0.0 ? 1.0 : 0.0; }),
                  oracle::halfSky(t), "half sky tilted by " + std::to_string(int(degrees)));
    }
}

TEST(ReferenceOracles, SpheresAtInfinity)
{
    const double degree = pi / 180.0;
    for (const auto& [radius, zenith] : {std::pair(30.0, 20.0), {10.0, 60.0}, {60.0, 90.0}, {30.0, 80.0}, {30.0, 100.0}})
        expectSky(ConeEnvironment(radius * degree, zenith * degree), oracle::sphere(radius * degree, zenith * degree),
                  "sphere of " + std::to_string(int(radius)) + " at " + std::to_string(int(zenith)));
    EXPECT_NEAR(oracle::sphere(60.0 * degree, 90.0 * degree), 0.195501, 1e-6);
    EXPECT_NEAR(oracle::sphere(30.0 * degree, 100.0 * degree), 0.011284, 1e-6);
}

TEST(ReferenceOracles, DiscAndSphereBlock)
{
    expectBlocker(makeDisc(0.7, 1.0, 512), oracle::coaxialDisk(0.7, 1.0), "disc");  // 512 corners miss 2.5e-5 of its area
    // The inscribed polyhedron of 256 segments is smaller by up to 2 (1 - cos(pi / 256)) = 1.5e-4 of the solid angle.
    const double w = 70.0 * pi / 180.0;
    const osg::Vec3d centre(2.0 * std::sin(w), 0, 2.0 * std::cos(w));
    expectBlocker(makeSphere(centre, 1.0, 256), oracle::sphere(std::asin(0.5), w), "sphere crossing the horizon");
}

TEST(ReferenceOracles, RectanglesBlock)
{
    expectBlocker(makeQuad(osg::Vec3d(0, 0, 1), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)), oracle::rectangleCorner(1, 1, 1),
                  "corner");
    expectBlocker(makeQuad(osg::Vec3d(-0.5, -0.5, 1), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)),
                  oracle::centredRectangle(1, 1, 1), "centred square");
    // Half of it below the horizon.
    expectBlocker(makeQuad(osg::Vec3d(0.7, -0.5, -0.5), osg::Vec3d(0, 1, 0), osg::Vec3d(0, 0, 1)),
                  oracle::verticalRectangle(0.7, 0.5, 0.5), "vertical square through the horizon");
}

TEST(ReferenceOracles, InfiniteWalls)
{
    for (double a : {0.1, 0.5, 1.0}) {
        const double truth = oracle::wallOcclusion(a, 1.0);
        const double half = 300.0;
        EXPECT_LT(truth - oracle::verticalRectangle(a, half, 1.0), 1e-4);
        expectBlocker(makeQuad(osg::Vec3d(a, -half, 0), osg::Vec3d(0, 2 * half, 0), osg::Vec3d(0, 0, 1)), truth,
                      "wall at " + std::to_string(a));
    }
}

}  // namespace Oracles_test
