// SPDX-License-Identifier: MIT
// Area lights beside maps, lobes, mirrors and each other, and along paths: every way of light is counted once.
#include "Lamps.h"
#include "Maths.h"
#include "Oracles.h"

namespace EmitterPaths_test
{

using osgEnvLight::Material;
using testmaths::pi;
using testmaths::Random;
namespace oracle = testmaths::oracle;

namespace
{

osg::ref_ptr<osg::Geode> glossyFloor(double roughness)
{
    const osg::ref_ptr<osg::Geode> quad = floorOf(2.0);
    Material::setCookTorrance(*quad->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.9f, 0.9f), 1.0f, float(roughness));
    return quad;
}

}  // namespace

TEST(ReferenceEmitters, MapAndLightsAddUp)
{
    // Black, the lamp is drawn and lights nothing: it hides as much of the map.
    const auto light = sphere(osg::Vec3d(0.3, 0.2, 1), 0.3, 2.0);
    const auto ball = [] {
        osg::ref_ptr<osg::Geode> node = makeSphere(osg::Vec3d(-0.2, 0, 0.25), 0.25, 48);
        Material::setCookTorrance(*node->getOrCreateStateSet(), osg::Vec3f(0.6f, 0.2f, 0.2f), 0.3f, 0.4f);
        return node;
    }();
    const auto scene = together({whiteFloor(1.0), ball, light});
    const auto render = [&](double radiance, const Environment& sky, ReferenceOptions::Estimator estimator) {
        light->setRadiance(osg::Vec3f(1, 1, 1) * float(radiance));
        const Traced view = perspectiveView(*scene, osg::Vec3d(1, -3, 2), osg::Vec3d(0, 0, 0.2), 32);
        return view.render(sky, options(estimator, ReferenceOptions::FULL, 32), allTerms);
    };
    for (const auto estimator : allEstimators) {
        const ReferenceResult both = render(2.0, day, estimator), map = render(0.0, day, estimator),
                              lit = render(2.0, night, estimator);
        for (Layer layer :
             {Layer::BEAUTY, Layer::DIFFUSE, Layer::OCCLUSION, Layer::SPECULAR, Layer::SPECULAR_VISIBLE, Layer::EMISSION}) {
            const Estimate a = estimateOf(both, layer), b = estimateOf(map, layer), c = estimateOf(lit, layer);
            expectNear({a.value, std::hypot(a.error, std::hypot(b.error, c.error)), a.pixels}, b.value + c.value,
                       std::string(nameOf(estimator)) + ", layer " + std::to_string(int(layer)));
            EXPECT_GT(c.value, 0.0);
        }
    }
}

// Found by the paths that meet it or sampled, its light is the same.
TEST(ReferenceEmitters, ALampIsItsTriangles)
{
    const osg::ref_ptr<osg::Geode> bulb = makeSphere(osg::Vec3d(0.3, 0.2, 0.8), 0.3, 24);
    Material::setLambert(*bulb->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f));
    Material::setEmission(*bulb->getStateSet(), osg::Vec3f(2, 2, 2));
    const auto ball = makeSphere(osg::Vec3d(-0.4, 0, 0.25), 0.25, 24);
    Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3f(0.6f, 0.2f, 0.2f), 0.3f, 0.4f);
    const auto render = [&](osg::Node& lamp, ReferenceOptions::Paths paths, double leastLamp, unsigned samples) {
        const auto scene = together({whiteFloor(1.0), ball, &lamp});
        const Traced view = perspectiveView(*scene, osg::Vec3d(1, -3, 2), osg::Vec3d(0, 0, 0.2), 32, 40.0, leastLamp);
        return estimateOf(view.render(night, options(ReferenceOptions::MIS, paths, samples), allTerms), Layer::BEAUTY);
    };
    const Estimate met = render(*bulb, ReferenceOptions::FULL, HUGE_VAL, 1024);
    const Estimate sampled = render(*bulb, ReferenceOptions::FULL, 1.0, 16);
    expectNear({met.value, std::hypot(met.error, sampled.error), met.pixels}, sampled.value, "full");
    EXPECT_GT(sampled.value, 0.1);
    EXPECT_LT(sampled.error, 0.6 * 8.0 * met.error);  // at a 64th of the samples, which alone would cost a factor of 8
    EXPECT_EQ(render(*bulb, ReferenceOptions::FULL, 2.5, 16).value, render(*bulb, ReferenceOptions::FULL, HUGE_VAL, 16).value);

    // Direct light, as of an area light in its place; of the ball's facets 1 % less.
    const Estimate direct = render(*bulb, ReferenceOptions::DIRECT, 1.0, 64);
    const Estimate light = render(*sphere(osg::Vec3d(0.3, 0.2, 0.8), 0.3, 2.0), ReferenceOptions::DIRECT, HUGE_VAL, 64);
    EXPECT_NEAR(direct.value, light.value, 0.015 * light.value + 3.0 * std::hypot(direct.error, light.error));
}

TEST(ReferenceEmitters, GlossyFloorsReflectAScreen)
{
    const osg::ref_ptr<AreaLight> screen = lamp(2.0);
    screen->setRectangle(osg::Vec3d(0, 1, 0.8), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0, 0.7));
    for (const double roughness : {0.2, 0.4, 0.8}) {
        const auto scene = together({glossyFloor(roughness), screen});
        const Traced view = perspectiveView(*scene, osg::Vec3d(0.3, -2, 1), osg::Vec3d(0, 0.3, 0), 24);
        const Estimate mis = estimateOf(
            view.render(night, options(ReferenceOptions::MIS, ReferenceOptions::DIRECT, 16), allTerms), Layer::SPECULAR_VISIBLE);
        EXPECT_LT(mis.error, 0.002 * mis.value);
        RecordProperty("mis " + std::to_string(roughness), std::to_string(mis.error / mis.value));
        for (const auto estimator : {ReferenceOptions::COSINE, ReferenceOptions::UNIFORM}) {
            const Estimate blind = estimateOf(view.render(night, options(estimator, ReferenceOptions::DIRECT, 128), allTerms),
                                              Layer::SPECULAR_VISIBLE);
            expectSame(mis, blind, std::to_string(roughness) + ", " + nameOf(estimator));
        }
    }
}

TEST(ReferenceEmitters, AMirrorShowsTheLamp)
{
    const auto mirror = glossyFloor(0.0);
    // Under a constant sky the mirror shows its own reflectance.
    const osg::Vec3d eye(0, -1, 1), target(0, 0, 0);
    const double reflectance = estimateOf(perspectiveView(*mirror, eye, target, 8, 1.0)
                                              .render(day, options(ReferenceOptions::MIS, ReferenceOptions::DIRECT, 1)),
                                          Layer::BEAUTY)
                                   .value;
    const osg::ref_ptr<AreaLight> screen = lamp(5.0);
    screen->setRectangle(osg::Vec3d(0, 1, 1), osg::Vec3d(0.4, 0, 0), osg::Vec3d(0, 0.3, -0.3));
    screen->setTwoSided(true);
    const osg::ref_ptr<osg::Node> cover =
        lambert(makeQuad(osg::Vec3d(-1, 0.5, 0.2), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 0, 1)), 0.0);
    for (const auto& light : {screen, sphere(osg::Vec3d(0, 1, 1), 0.3, 5.0), invisible(sphere(osg::Vec3d(0, 1, 1), 0.3, 5.0))})
        for (const auto estimator : allEstimators)
            for (const auto paths : {ReferenceOptions::UNOCCLUDED, ReferenceOptions::DIRECT, ReferenceOptions::FULL}) {
                const auto of = [&](osg::Node& scene) {
                    return estimateOf(
                        perspectiveView(scene, eye, target, 8, 1.0).render(night, options(estimator, paths, 2), allTerms),
                        Layer::SPECULAR_VISIBLE);
                };
                EXPECT_NEAR(5.0 * reflectance, of(*together({mirror, light})).value, 1e-3) << nameOf(estimator) << paths;
                const bool occluded = paths != ReferenceOptions::UNOCCLUDED;
                EXPECT_NEAR(occluded ? 0.0 : 5.0 * reflectance, of(*together({mirror, light, cover})).value, 1e-3);
            }
    // Along paths, too, it is counted once.
    const Traced view = perspectiveView(*together({mirror, screen}), eye, target, 8, 1.0);
    EXPECT_NEAR(5.0 * reflectance,
                estimateOf(view.render(night, options(ReferenceOptions::MIS, ReferenceOptions::FULL, 16)), Layer::BEAUTY).value,
                1e-3);
}

// A lamp in the middle of a closed sphere: the light that is sent on and on.
TEST(ReferenceEmitters, EnergyIsKept)
{
    // Points of a chord of an inscribed polyhedron see the wall a little differently: of the order of (pi / 128)^2 = 6e-4.
    const double slack = 1e-3, flux = 4.0 * pi, radius = 0.3;
    for (const double rho : {0.5, 0.9}) {
        const osg::ref_ptr<osg::Geode> wall = makeSphere(osg::Vec3d(), 1.0, 256);
        wall->getDrawable(0)->asGeometry()->setNormalArray(nullptr);
        lambert(wall, rho);
        for (const auto estimator : {ReferenceOptions::MIS, ReferenceOptions::COSINE}) {
            const bool blind = estimator == ReferenceOptions::COSINE;
            if (blind && rho > 0.6) continue;  // as the other one, only longer
            const auto light = sphere(osg::Vec3d(), radius);
            light->setFlux(osg::Vec3f(1, 1, 1) * float(flux));
            const auto of = [&] {
                const auto scene = together({wall, light});
                return estimateOf(perspectiveView(*scene, osg::Vec3d(0, 0, -0.5), osg::Vec3d(0.3, 0.2, -1), 24, 20.0)
                                      .render(night, options(estimator, ReferenceOptions::FULL, 16)),
                                  Layer::BEAUTY);
            };
            const std::string what = std::string(nameOf(estimator)) + ", rho " + std::to_string(rho);
            // It takes what falls back on it.
            const double exitance = flux / (4.0 * pi * radius * radius);
            expectNear(of(), oracle::concentricSpheres(radius, 1.0, exitance, 0.0, 0.0, rho).second / pi, what, slack);
            light->setVisible(false);
            expectNear(of(), flux * rho / (4.0 * pi * pi * (1.0 - rho)), "invisible, " + what, slack);
        }
    }
}

// A lamp in a room as emissive geometry, found by paths alone, and as a light.
TEST(ReferenceEmitters, ALampOfPathsIsTheSameLamp)
{
    const osg::ref_ptr<osg::Node> walls = emissive(makeBox(osg::Vec3d(-2, -2, 0), osg::Vec3d(2, 2, 2)), 0.0, 0.7);
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(0.5, 0.5, 0.5), 0.5, 32);
    Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.9f, 0.9f), 0.5f, 0.3f);
    const auto light = rectangle(osg::Vec3d(0, 0, 1.9), 1, 1, 4.0);
    light->setTwoSided(true);
    const osg::ref_ptr<osg::Node> quad =
        emissive(makeQuad(osg::Vec3d(-0.5, -0.5, 1.9), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)), 4.0);
    const auto of = [&](osg::Node& lampNode, ReferenceOptions::Estimator estimator, unsigned pass) {
        const auto scene = together({walls, ball, &lampNode});
        const Traced view = perspectiveView(*scene, osg::Vec3d(1.5, -1.8, 1.2), osg::Vec3d(0, 0, 0.7), 24, 60.0);
        return estimateOf(view.render(night, options(estimator, ReferenceOptions::FULL, pass)), Layer::BEAUTY);
    };
    const Estimate paths = of(*quad, ReferenceOptions::MIS, 64), mis = of(*light, ReferenceOptions::MIS, 16);
    expectSame(paths, mis, "mis");
    expectSame(paths, of(*light, ReferenceOptions::COSINE, 64), "cosine");
    EXPECT_LT(mis.error, 0.004 * mis.value);
    RecordProperty("paths", std::to_string(paths.error / paths.value));
    RecordProperty("mis", std::to_string(mis.error / mis.value));
}

TEST(ReferenceEmitters, ManyOfAllShapesAtAllDistances)
{
    Random random(7);
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(whiteFloor(1.0));
    for (int i = 0; i < 40; ++i) {
        const double size = random.uniform(0.02, 0.4), radiance = random.uniform(0.1, 10.0);
        const osg::Vec3d at(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.05, 2.0));
        const auto s = float(size);
        const osg::ref_ptr<AreaLight> light = i % 4 == 0   ? rectangle(osg::Vec3d(), size, 2.0 * size, radiance)
                                              : i % 4 == 1 ? disc(osg::Vec3d(), size, radiance)
                                              : i % 4 == 2
                                                  ? sphere(osg::Vec3d(), size, radiance)
                                                  : polygon({{-s, -s, 0}, {0, 0.3f * s, 0}, {s, -s, 0}, {0, s, 0}}, radiance);
        light->setTwoSided(i % 3 == 0);
        const osg::Vec3d axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        scene->addChild(moved(osg::Matrixd::rotate(random.uniform(0, 3), axis) * osg::Matrixd::translate(at), light));
    }
    const Traced view = perspectiveView(*scene, osg::Vec3d(0, -4, 5), osg::Vec3d(), 24, 30.0);
    for (Layer layer : {Layer::BEAUTY, Layer::DIFFUSE}) {
        const Estimate mis =
            estimateOf(view.render(night, options(ReferenceOptions::MIS, ReferenceOptions::DIRECT, 32), allTerms), layer);
        for (const auto estimator : {ReferenceOptions::COSINE, ReferenceOptions::UNIFORM})
            expectSame(mis, estimateOf(view.render(night, options(estimator, ReferenceOptions::DIRECT, 128), allTerms), layer),
                       nameOf(estimator));
    }
}

TEST(ReferenceEmitters, WhatCanNotLightIsNamedOnce)
{
    const auto broken = sphere(osg::Vec3d(0, 0, 1), 0.0);
    broken->setName("broken");
    const auto scene =
        together({whiteFloor(), broken, moved(osg::Matrixd::translate(1, 0, 0), broken), sphere(osg::Vec3d(0, 0, 2), 0.1, 0.0)});
    const Traced view = originOf(*scene);
    EXPECT_EQ(std::vector<std::string>{"area light 'broken' has no area"}, view.triangles().leftOut);
    EXPECT_TRUE(view.triangles().emitters.empty());
    EXPECT_EQ(0.0, estimateOf(view.render(night, options(ReferenceOptions::MIS)), Layer::BEAUTY).value);
}

TEST(ReferenceEmitters, IntegrandsAndLightListsHaveThem)
{
    const auto scene = together({whiteFloor(), rectangle(osg::Vec3d(0, 0, 1), 2, 1)});
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewport(0, 0, 1, 1);
    camera->setViewMatrixAsLookAt(osg::Vec3d(0, 0, 1e-3), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    camera->setProjectionMatrixAsOrtho(-1e-4, 1e-4, -1e-4, 1e-4, 0.0, 1.0);
    const osgEnvLight::TriangleScene triangles = osgEnvLight::flattenScene(*scene, *camera, nullptr, {true});
    const osgEnvLight::RayScene rays(triangles);
    const osgEnvLight::RayCamera rayCamera(camera->getViewMatrix(), camera->getProjectionMatrix(), 1, 1, 0.0);
    osgEnvLight::Reference reference(rays, rayCamera, day);
    const double lit = oracle::centredRectangle(2, 1, 1);
    // Blocked, the sky is hidden behind the lamp.
    for (const bool occluded : {false, true}) {
        const Picture p = reference.integrand(0, 0, 1024, occluded);
        double sum = 0.0;
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x)
                sum += double(p.at(x, y)[0]) * std::cos(pi * ((y + 0.5) / p.height - 0.5)) * 2.0 * pi * pi / (p.width * p.height);
        EXPECT_NEAR(occluded ? 1.0 : 1.0 + lit, sum, 2e-3);
    }
    const osgEnvLight::LightList list = {{osg::Vec3d(0, 0, 1), osg::Vec3d(1, 1, 1) * pi}};
    reference.setLights(&list);
    for (const auto estimator : allEstimators) {
        const ReferenceResult result = reference.render(options(estimator, ReferenceOptions::UNOCCLUDED, 512), allTerms);
        expectNear(estimateOf(result, Layer::DIFFUSE), 1.0 + lit, nameOf(estimator));
    }
}

}  // namespace EmitterPaths_test
